# SPDX-License-Identifier: Apache-2.0
"""The last state of a world that meant something."""

from __future__ import annotations

from typing import Any

import numpy as np

_FASTEST = 1e4
"""The norm of all velocities, m/s and rad/s, beyond which a state means nothing."""


class LastSound:
    """
    Backup of the state before a step, to restore if the physics becomes unstable.

    Parameters
    ----------
    data
        The state of MuJoCo, of which a copy is kept at once.

    """

    def __init__(self, data: Any) -> None:
        self._data = data
        self._qpos, self._qvel = data.qpos.copy(), data.qvel.copy()

    def keep(self) -> None:
        """Keep the present state."""
        np.copyto(self._qpos, self._data.qpos)
        np.copyto(self._qvel, self._data.qvel)

    @property
    def is_lost(self) -> bool:
        """Tell whether velocities are beyond all bounds, or no numbers."""
        qvel = self._data.qvel
        return not float(qvel @ qvel) < _FASTEST * _FASTEST

    def restore(self) -> None:
        """Go back; what follows from the state is left to be computed."""
        data = self._data
        data.qpos[:], data.qvel[:] = self._qpos, self._qvel
        data.qacc[:] = data.qacc_warmstart[:] = 0.0
