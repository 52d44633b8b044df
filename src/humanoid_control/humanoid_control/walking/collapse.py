# SPDX-License-Identifier: Apache-2.0
"""Compliant fall: the joints yield, towards a posture that protects the robot."""

from __future__ import annotations

from humanoid_control.backends import Array, JointTargets
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.sides import NAMES, outwards, SIDES
from humanoid_control.walking.walking_robot import WalkingRobot
import numpy as np

_CROUCHED_RAD = {'hip_pitch': -1.1, 'knee': 1.9, 'ankle_pitch': -0.8}
_ARMS_RAD = {'shoulder': -0.6, 'elbow': -1.2}
_ARM_ROLL_RAD = 0.4


class Collapse:
    """
    Compliant fall in progress, and the limp state after it.

    Targets near the measured positions reduce the stiffness of the servos to a fraction; their
    damping is unchanged. The knees yield, and the robot sinks. Later the fraction is zero: the
    robot lies still, and its joints can be moved by hand.

    Parameters
    ----------
    robot
        The robot, whose joints become compliant.
    parameters : WalkParameters
        Gait parameters, with the stiffness and the duration of a compliant fall.
    time_s
        Time of the observation at which the fall starts.

    Raises
    ------
    DynamicsError
        The robot lacks a joint of the protective posture.

    """

    name = 'fallen'

    def __init__(self, robot: WalkingRobot, parameters: WalkParameters, time_s: float) -> None:
        self._parameters = parameters
        self._start_s = time_s
        self._posture_rad = _protective_posture(robot)

    def targets(self, time_s: float, positions_rad: Array) -> JointTargets:
        """
        Compute the joint targets of a compliant fall.

        Parameters
        ----------
        time_s
            Time of the observation, on the same clock as the start of the fall.
        positions_rad
            Measured joint positions (n,).

        Returns
        -------
        JointTargets
            Positions a fraction of the way from the measured ones to a protective posture, which
            acts as a lower stiffness (none after `collapse_s`); velocities and efforts are zero.

        """
        p, zeros = self._parameters, np.zeros(len(positions_rad))
        falls = time_s - self._start_s < p.fall.collapse_s
        share = p.fall.collapse_stiffness if falls else 0.0
        wanted = positions_rad + share * (self._posture_rad - positions_rad)
        return JointTargets(wanted, zeros, zeros.copy())


def _protective_posture(robot: WalkingRobot) -> Array:
    """Compute the protective posture (n,): crouched, with the arms in front of the body."""
    posture = np.zeros(len(robot.body.joints))
    for side in SIDES:
        for joint, angle_rad in {**_CROUCHED_RAD, **_ARMS_RAD}.items():
            posture[robot.index(f'{NAMES[side]}_{joint}')] = angle_rad
        roll = robot.index(f'{NAMES[side]}_shoulder_roll')
        posture[roll] = outwards(side) * _ARM_ROLL_RAD
    return posture
