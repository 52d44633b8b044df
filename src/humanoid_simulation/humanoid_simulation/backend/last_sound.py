# SPDX-License-Identifier: Apache-2.0
"""Backup of the last valid simulation state."""

from __future__ import annotations

from typing import Any

import numpy as np

_FASTEST = 1e4
"""Norm of `qvel`, in m/s and rad/s, above which a state counts as diverged."""


class LastSound:
    """
    Backup of the state before a step, to restore if the physics becomes unstable.

    Parameters
    ----------
    data
        The MuJoCo state, which is copied immediately.

    """

    def __init__(self, data: Any) -> None:
        self._data = data
        self._qpos, self._qvel = data.qpos.copy(), data.qvel.copy()

    def keep(self) -> None:
        """Save the current state."""
        np.copyto(self._qpos, self._data.qpos)
        np.copyto(self._qvel, self._data.qvel)

    @property
    def is_lost(self) -> bool:
        """Whether the velocities have diverged or are not finite."""
        qvel = self._data.qvel
        return not float(qvel @ qvel) < _FASTEST * _FASTEST

    def restore(self) -> None:
        """Restore the saved state; derived quantities are not recomputed."""
        data = self._data
        data.qpos[:], data.qvel[:] = self._qpos, self._qvel
        data.qacc[:] = data.qacc_warmstart[:] = 0.0
