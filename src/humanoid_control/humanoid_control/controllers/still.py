# SPDX-License-Identifier: Apache-2.0
"""Controller that holds the joints during a stop."""

from __future__ import annotations

from collections.abc import Sequence

from humanoid_control.controllers.hold import Hold
from humanoid_control.controllers.interface import Mask
import numpy as np


class Still(Hold):
    """
    Controller that, while on, holds all joints that the mode leaves to controllers.

    Parameters
    ----------
    joints
        All joints of the robot, in the order of its targets.

    Attributes
    ----------
    on
        Whether it claims the joints; initially off.

    """

    way_out = 'wait until the robot is released'

    def __init__(self, joints: Sequence[str]) -> None:
        super().__init__(joints, name='stop')
        self.on = False
        self._all = np.ones(len(self.joints), dtype=np.bool_)
        self._none = np.zeros_like(self._all)

    @property
    def waits(self) -> bool:
        """Whether a start is pending: never."""
        return False

    def wanted(self, now_s: float) -> Mask:
        """
        Claim all joints while it is switched on, else none.

        Parameters
        ----------
        now_s
            Not used.

        Returns
        -------
        Mask
            Over all joints (n,).

        """
        return self._all if self.on else self._none

    def cancel(self) -> None:
        """Stay on or off: a reset or a mode change does not release the robot from a stop."""
