# SPDX-License-Identifier: Apache-2.0
"""Getting up: which motion follows from how the robot lies, and the targets of the joints."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
import math

from humanoid_control.backends import Array, JointTargets
from humanoid_control.walking.get_up_motions import (
    Keyframe,
    KNEEL,
    MOTIONS,
    RISE,
    ROLL_OVER,
    STRETCH,
)
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.walking_robot import RobotState, WalkingRobot
import numpy as np

BACK, FACE, LEFT_SIDE, RIGHT_SIDE, UPRIGHT = 'back', 'face', 'left side', 'right side', 'upright'
_UPRIGHT_RAD = 0.6
"""Tilt of the base below which it is upright: the robot kneels, squats, or is held."""
_TIPPED_RAD = 1.0
"""Tilt beyond which a robot that rises has fallen over."""
_OTHER = {'left': 'right', 'right': 'left'}
_MIDDLE = ('waist', 'head')
_NEXT = {
    (STRETCH, BACK): ROLL_OVER,
    (STRETCH, LEFT_SIDE): ROLL_OVER,
    (STRETCH, RIGHT_SIDE): ROLL_OVER,
    (STRETCH, FACE): KNEEL,
    (ROLL_OVER, FACE): KNEEL,
    (KNEEL, UPRIGHT): RISE,
}
"""Motion that follows a motion, by how the robot lies after it; else it stretches out again."""


def lying_on(up: Sequence[float]) -> str:
    """
    Recognise how a robot lies.

    Parameters
    ----------
    up
        Unit vector (3,) of the vertical, upwards, in the axes of the base.

    Returns
    -------
    str
        `BACK`, `FACE`, `LEFT_SIDE`, `RIGHT_SIDE` or `UPRIGHT`.

    """
    forward, left, along = up
    if along > math.cos(_UPRIGHT_RAD):
        return UPRIGHT
    if abs(left) > abs(forward):
        return RIGHT_SIDE if left > 0.0 else LEFT_SIDE
    return BACK if forward > 0.0 else FACE


def sided(joints_rad: Mapping[str, float], mirrored: bool) -> dict[str, float]:
    """
    Expand joints that are named without a side to both sides, and mirror them if asked for.

    Parameters
    ----------
    joints_rad
        Positions by joint; those without a side are for the left one.
    mirrored
        Whether to exchange the sides, and to reverse what turns about the x or the z axis.

    """
    result: dict[str, float] = {}
    for joint, angle_rad in joints_rad.items():
        turned_rad = -angle_rad if joint.endswith(('_roll', '_yaw')) else angle_rad
        part, _, own = joint.partition('_')
        if part in _OTHER:
            result[f'{_OTHER[part]}_{own}' if mirrored else joint] = (
                turned_rad if mirrored else angle_rad
            )
        elif part in _MIDDLE:
            result[joint] = turned_rad if mirrored else angle_rad
        else:
            result[f'left_{joint}'], result[f'right_{joint}'] = angle_rad, turned_rad
    return result


def minimum_jerk(
    start_rad: Array, goal_rad: Array, duration_s: float, passed_s: float
) -> JointTargets:
    """
    Compute the joint targets of a minimum-jerk motion from rest to rest (Flash and Hogan, 1985).

    Parameters
    ----------
    start_rad, goal_rad
        Joint positions (n,) at its start and at its end.
    duration_s
        Its duration; when it has passed, or is zero, the joints rest at the goal.
    passed_s
        Time since its start.

    Returns
    -------
    JointTargets
        Positions and velocities (n,); efforts are zero.

    """
    zeros = np.zeros(len(goal_rad))
    if passed_s >= duration_s:
        return JointTargets(goal_rad, zeros, zeros.copy())
    t = passed_s / duration_s
    way_rad = goal_rad - start_rad
    share = t**3 * (10.0 - 15.0 * t + 6.0 * t**2)
    rate_1_s = 30.0 * t**2 * (1.0 - t) ** 2 / duration_s
    return JointTargets(start_rad + share * way_rad, rate_1_s * way_rad, zeros)


class Rising:
    """
    Minimum-jerk motion of the joints to the standing posture (Flash and Hogan, 1985).

    Parameters
    ----------
    start_rad, home_rad
        Joint positions (n,) at the start, as measured, and in the standing posture.
    parameters : WalkParameters
        Gait parameters, with the duration.
    time_s
        Time of the observation at which the motion starts.

    """

    name = 'stand_up'

    def __init__(
        self, start_rad: Array, home_rad: Array, parameters: WalkParameters, time_s: float
    ) -> None:
        self._start_rad, self._home_rad = start_rad.copy(), home_rad
        self._duration_s = parameters.fall.stand_up_s
        self._start_s = time_s

    def is_done(self, time_s: float) -> bool:
        """
        Check whether the targets have arrived at the standing posture.

        Parameters
        ----------
        time_s
            Present time, on the same clock as the start.

        """
        return time_s - self._start_s >= self._duration_s

    def targets(self, time_s: float) -> JointTargets:
        """
        Compute the joint targets of the minimum-jerk motion to the standing posture.

        Parameters
        ----------
        time_s
            Present time, on the same clock as the start.

        Returns
        -------
        JointTargets
            Positions and velocities (n,); efforts are zero.

        """
        passed_s = time_s - self._start_s
        return minimum_jerk(self._start_rad, self._home_rad, self._duration_s, passed_s)


class GetUp:
    """
    Motions from lying to standing, each chosen from how the robot lies when the last has ended.

    First the robot stretches out. From its back it rolls over onto its face; from its face it
    draws its knees up, throws its body upright and sits on its heels; from there it tips onto its
    soles and stands up. When a motion did not lead where it should, it stretches out again.

    Parameters
    ----------
    robot
        The robot, whose joints move.
    balance_nm
        Computes the joint torques (n,) that keep its balance on both soles, from its state.
    parameters : WalkParameters
        Gait parameters, with the unit of time of the motions and the number of tries.
    time_s
        Time of the observation at which getting up starts.
    positions_rad
        Measured joint positions (n,) at that time.

    Attributes
    ----------
    is_over
        Whether the last motion has ended: the robot is on its feet, or it has given up.

    Raises
    ------
    DynamicsError
        The robot lacks a joint that a motion moves.

    """

    name = 'stand_up'

    def __init__(
        self,
        robot: WalkingRobot,
        balance_nm: Callable[[RobotState], Array],
        parameters: WalkParameters,
        time_s: float,
        positions_rad: Array,
    ) -> None:
        self._robot, self._fall = robot, parameters.fall
        self._motion, self._tries = '', 0
        self._mirrored, self._balances = False, False
        self._balance_nm = balance_nm
        self._keyframes: Iterator[Keyframe] = iter(())
        self._since_s, self._duration_s = time_s, 0.0
        self._start_rad = self._goal_rad = positions_rad.copy()
        self._last = minimum_jerk(positions_rad, positions_rad, 0.0, 0.0)
        self.is_over = False

    @property
    def is_rising(self) -> bool:
        """Whether the robot kneels, squats or stands up, so that its base is upright."""
        return self._motion == RISE

    def update(self, sensed: RobotState, is_on_feet: bool) -> JointTargets:
        """
        Advance the motions by one control period.

        Parameters
        ----------
        sensed
            Estimated state of the robot.
        is_on_feet
            Whether its base is upright, and as high as when it stands.

        Returns
        -------
        JointTargets
            Positions and velocities (n,) of a minimum-jerk motion to the keyframe at hand; efforts
            are zero unless the robot balances.

        """
        time_s, up = sensed.time_s, sensed.state.base_rotation[2].tolist()
        if self.is_rising and up[2] < math.cos(_TIPPED_RAD):
            self._start_rad = self._goal_rad = self._last.positions_rad
            self._since_s, self._duration_s, self._keyframes = time_s, 0.0, iter(())
        while not self.is_over and time_s - self._since_s >= self._duration_s:
            self._since_s += self._duration_s
            self._start_rad, self._duration_s = self._goal_rad, 0.0
            keyframe = next(self._keyframes, None)
            if keyframe is None:
                self._choose(up, is_on_feet)
            else:
                self._duration_s = keyframe.duration_s * self._fall.get_up_unit_s
                self._balances = keyframe.balances
                self._goal_rad = self._posture(keyframe)
        passed_s = time_s - self._since_s
        targets = minimum_jerk(self._start_rad, self._goal_rad, self._duration_s, passed_s)
        if self._balances:
            targets = replace(targets, efforts_nm=self._balance_nm(sensed))
        self._last = targets
        return targets

    def _choose(self, up: Sequence[float], is_on_feet: bool) -> None:
        """Choose the next motion from how the robot lies now."""
        lies = lying_on(up)
        motion = _NEXT.get((self._motion, lies), STRETCH)
        self._tries += motion == STRETCH
        self.is_over = is_on_feet or self._tries > self._fall.get_up_tries
        if not self.is_over:
            self._motion, self._keyframes = motion, iter(MOTIONS[motion])
            # It rolls over to the side on which it lies, else to one after the other.
            on_side = {LEFT_SIDE: False, RIGHT_SIDE: True}
            self._mirrored = on_side.get(lies, self._tries % 2 == 0)

    def _posture(self, keyframe: Keyframe) -> Array:
        """Compute the joint positions (n,) of a keyframe; joints that it does not name stay."""
        posture: Array = self._goal_rad.copy()
        for joint, angle_rad in sided(keyframe.joints_rad, self._mirrored).items():
            posture[self._robot.index(joint)] = angle_rad
        return posture
