# SPDX-License-Identifier: Apache-2.0
"""Goals of joint trajectory controllers: their tolerances, and their validation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
import math

from humanoid_common.naming import did_you_mean, shortened
from humanoid_control.backends import Array, JointLimits
from humanoid_control.controllers.commands import CommandError, JointNames
from humanoid_control.controllers.trajectory import checked_trajectory, Trajectory, TrajectoryPoint
import numpy as np

GOAL_TOLERANCE_RAD = 0.1
"""Default goal tolerance of positions: an arm sags a little under its weight."""
_AT_REST_RAD_S = 1e-6
ERASED = -1.0
"""The value that removes a tolerance (control_msgs/JointTolerance)."""


@dataclass(frozen=True)
class TrajectoryRequest:
    """A trajectory goal as requested."""

    joints: Sequence[str]
    points: Sequence[TrajectoryPoint]
    path: Sequence[JointTolerance] = ()
    """Path tolerances."""
    goal: Sequence[JointTolerance] = ()
    """Goal tolerances."""
    goal_time_s: float = 0.0
    """Goal time tolerance: the goal may be reached late by this amount; 0 is any time."""
    start_in_s: float = 0.0
    """Time from now to the start of the trajectory; negative if it has started already."""


@dataclass(frozen=True, eq=False)
class TrajectoryGoal:
    """A validated goal, for all joints of the controller in their order."""

    trajectory: Trajectory
    path: StateTolerances
    goal: StateTolerances
    goal_time_s: float
    """Goal time tolerance; infinite for any time."""


def checked_goal(
    controller: str,
    own: Sequence[str],
    robot: JointNames,
    limits: JointLimits,
    request: TrajectoryRequest,
) -> TrajectoryGoal:
    """
    Validate a trajectory goal of a controller.

    Parameters
    ----------
    controller
        The name of the controller that is to run it.
    own
        The joints of the controller.
    robot, limits
        All joints of the robot, and their limits.
    request
        The requested goal.

    Raises
    ------
    CommandError
        The goal is rejected; the message states the first reason.

    """
    _check_joints(controller, own, robot, request.joints)
    trajectory = checked_trajectory(robot, limits, request.joints, request.points)
    _check_end(trajectory, request.joints)
    return TrajectoryGoal(
        _shifted(_ordered(trajectory, own, request.joints), request.start_in_s),
        StateTolerances.of(own, request.path),
        StateTolerances.of(own, request.goal, GOAL_TOLERANCE_RAD),
        _checked_time(request.goal_time_s),
    )


def _check_joints(
    controller: str, own: Sequence[str], robot: JointNames, given: Sequence[str]
) -> None:
    """Check that a goal names exactly the joints of the controller."""
    robot.indices(given)
    foreign = [joint for joint in given if joint not in own]
    if foreign:
        raise CommandError(
            f"'{foreign[0]}' is not a joint of '{controller}', which has: {', '.join(own)}."
        )
    missing = [joint for joint in own if joint not in given]
    if missing:
        raise CommandError(
            f"It leaves out '{missing[0]}'. A goal of '{controller}' must name all its joints: "
            f'{", ".join(own)}.'
        )


def _check_end(trajectory: Trajectory, joints: Sequence[str]) -> None:
    """Check that a trajectory ends at rest; what follows the end is undefined."""
    if trajectory.velocities_rad_s is None:
        return
    moving = np.abs(trajectory.velocities_rad_s[-1]) > _AT_REST_RAD_S
    if moving.any():
        joint = int(np.argmax(moving))
        raise CommandError(
            f"Its last point leaves '{joints[joint]}' moving at "
            f'{trajectory.velocities_rad_s[-1, joint]:.3g} rad/s. End at rest.'
        )


def _ordered(trajectory: Trajectory, own: Sequence[str], given: Sequence[str]) -> Trajectory:
    """Reorder the columns of a trajectory to the order of the controller's joints."""
    order = [list(given).index(joint) for joint in own]
    velocities, accelerations = trajectory.velocities_rad_s, trajectory.accelerations_rad_s2
    return Trajectory(
        trajectory.indices[order],
        trajectory.times_s,
        trajectory.positions_rad[:, order],
        None if velocities is None else velocities[:, order],
        None if accelerations is None else accelerations[:, order],
    )


def _shifted(trajectory: Trajectory, start_in_s: float) -> Trajectory:
    """Shift a trajectory to its start time; reject one that has ended already."""
    times_s = trajectory.times_s + start_in_s
    if start_in_s and times_s[-1] <= 0.0:
        raise CommandError(
            f'By its header stamp, it ended {-times_s[-1]:.3g} s ago. Set the stamp to the start '
            'time, or to zero to start now.'
        )
    return replace(trajectory, times_s=times_s)


def _checked_time(goal_time_s: float) -> float:
    """Validate the goal time tolerance; 0 becomes infinity."""
    if not math.isfinite(goal_time_s) or goal_time_s < 0.0:
        raise CommandError(
            f'Its goal time tolerance is {goal_time_s:g} s. Give zero or more; zero means no '
            'limit.'
        )
    return goal_time_s or math.inf


@dataclass(frozen=True)
class JointTolerance:
    """Maximum errors of a joint: 0 is the controller's default, -1 allows any error."""

    joint: str
    position_rad: float = 0.0
    velocity_rad_s: float = 0.0


@dataclass(frozen=True, eq=False)
class StateTolerances:
    """Maximum errors of m joints, each array (m,); infinity allows any error."""

    joints: tuple[str, ...]
    position_rad: Array
    velocity_rad_s: Array

    @classmethod
    def of(
        cls,
        joints: Sequence[str],
        given: Sequence[JointTolerance],
        default_rad: float = math.inf,
    ) -> StateTolerances:
        """
        Combine the tolerances of a goal with the defaults.

        Parameters
        ----------
        joints
            The joints of the controller.
        given
            Tolerances of the goal, for any of these joints.
        default_rad
            Position tolerance of joints for which the goal has none.

        Raises
        ------
        CommandError
            A tolerance is for another joint, or has an invalid value.

        """
        position_rad = np.full(len(joints), default_rad)
        velocity_rad_s = np.full(len(joints), np.inf)
        for each in given:
            index = _index(each.joint, joints)
            position_rad[index] = _limit('position', each.joint, each.position_rad, default_rad)
            velocity_rad_s[index] = _limit('velocity', each.joint, each.velocity_rad_s, math.inf)
        return cls(tuple(joints), position_rad, velocity_rad_s)

    def violation(self, positions_rad: Array, velocities_rad_s: Array) -> str:
        """
        Describe the joint with the largest error beyond its tolerance; empty if there is none.

        Parameters
        ----------
        positions_rad, velocities_rad_s
            The errors of the joints, (m,).

        """
        for errors, limits, unit in (
            (positions_rad, self.position_rad, 'rad'),
            (velocities_rad_s, self.velocity_rad_s, 'rad/s'),
        ):
            sizes = np.abs(errors)
            beyond = sizes > limits
            if beyond.any():
                index = int(np.argmax(np.where(beyond, sizes, -1.0)))
                return (
                    f"'{self.joints[index]}' is off by {sizes[index]:.3f} {unit}, and "
                    f'{limits[index]:g} {unit} are tolerated'
                )
        return ''


def _index(joint: str, joints: Sequence[str]) -> int:
    """Look up the index of a joint; reject a joint of another controller."""
    if joint not in joints:
        raise CommandError(
            f"It has a tolerance of '{shortened(joint)}', which this controller does not have. "
            f'{did_you_mean(joint, joints)} It has: {", ".join(joints)}.'
        )
    return list(joints).index(joint)


def _limit(kind: str, joint: str, value: float, default: float) -> float:
    """Convert a tolerance value to the maximum error that it stands for."""
    if value == 0.0:
        return default
    if value == ERASED:
        return math.inf
    if not (math.isfinite(value) and value > 0.0):
        raise CommandError(
            f"The tolerance of the {kind} of '{joint}' is {value:g}. Give a number above zero, 0 "
            'for the default of the controller, or -1 for no limit.'
        )
    return value
