# SPDX-License-Identifier: Apache-2.0
"""Keep joints where they were told to be last."""

from __future__ import annotations

from collections.abc import Sequence

from humanoid_control.backends import JointTargets, Observation
from humanoid_control.controllers.interface import Mask
import numpy as np


class Hold:
    """Holds all joints at rest; what carried a load goes on to carry it."""

    def __init__(self, joints: Sequence[str], name: str = 'hold') -> None:
        """Hold nothing yet."""
        self.name = name
        self.joints = tuple(joints)
        none = np.zeros(len(self.joints))
        self._targets = JointTargets(none, none, none)

    def start(self, observation: Observation, held: JointTargets) -> None:
        """Hold from now on what the joints were told last."""
        rest = np.zeros(len(self.joints))
        self._targets = JointTargets(held.positions_rad, rest, held.efforts_nm)

    def take_back(self, joints: Mask, held: JointTargets) -> None:
        """Hold the joints that come back, (n,) true, where they were told to be last."""
        before = self._targets
        self._targets = JointTargets(
            np.where(joints, held.positions_rad, before.positions_rad),
            before.velocities_rad_s,
            np.where(joints, 0.0, before.efforts_nm),
        )

    def update(self, observation: Observation) -> JointTargets:
        """Return the same targets again."""
        return self._targets
