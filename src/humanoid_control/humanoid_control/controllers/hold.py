# SPDX-License-Identifier: Apache-2.0
"""Controller that holds joints at their last targets."""

from __future__ import annotations

from collections.abc import Sequence

from humanoid_control.backends import JointTargets, Observation
from humanoid_control.controllers.interface import Mask
import numpy as np


class Hold:
    """
    Controller that holds all joints at rest; joints that carry a load keep their efforts.

    Parameters
    ----------
    joints
        All joints of the robot, in the order of its targets.
    name
        Name of the controller, as shown to users.

    """

    def __init__(self, joints: Sequence[str], name: str = 'hold') -> None:
        self.name = name
        self.joints = tuple(joints)
        none = np.zeros(len(self.joints))
        self._targets = JointTargets(none, none, none)

    def start(self, observation: Observation, held: JointTargets) -> None:
        """
        Hold all joints at their last targets, with zero velocity and the same efforts.

        Parameters
        ----------
        observation, held
            As for `Controller.start`.

        """
        rest = np.zeros(len(self.joints))
        self._targets = JointTargets(held.positions_rad, rest, held.efforts_nm)

    def take_back(self, joints: Mask, held: JointTargets) -> None:
        """
        Hold joints that another controller has released, with zero velocity and effort.

        Parameters
        ----------
        joints
            Mask (n,) of the released joints; the others are held as before.
        held
            Targets of all n joints, at whose positions those joints are held.

        """
        before = self._targets
        self._targets = JointTargets(
            np.where(joints, held.positions_rad, before.positions_rad),
            before.velocities_rad_s,
            np.where(joints, 0.0, before.efforts_nm),
        )

    def update(self, observation: Observation) -> JointTargets:
        """
        Return the held targets, the same in every period.

        Parameters
        ----------
        observation
            Not used.

        Returns
        -------
        JointTargets
            Held targets of all n joints.

        """
        return self._targets
