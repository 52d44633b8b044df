# SPDX-License-Identifier: Apache-2.0
"""Joint trajectory controller: tracks the trajectory of a goal within tolerances, then holds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum

from humanoid_control.backends import Array, JointTargets, Observation
from humanoid_control.controllers.interface import GoalController
from humanoid_control.controllers.spline import Spline, spline_from
from humanoid_control.controllers.trajectory_goal import TrajectoryGoal

REACHED = 'Goal reached.'
LIMBS = {
    'left_arm_controller': ('left_shoulder', 'left_elbow', 'left_wrist'),
    'right_arm_controller': ('right_shoulder', 'right_elbow', 'right_wrist'),
    'head_controller': ('head_',),
    'waist_controller': ('waist_',),
}
"""Substrings of the joint names of each controller, after a prefix."""


class ErrorCode(IntEnum):
    """Error codes of a goal, with the values of control_msgs/action/FollowJointTrajectory."""

    SUCCESSFUL = 0
    INVALID_GOAL = -1
    INVALID_JOINTS = -2
    OLD_HEADER_TIMESTAMP = -3
    PATH_TOLERANCE_VIOLATED = -4
    GOAL_TOLERANCE_VIOLATED = -5


@dataclass(frozen=True)
class GoalResult:
    """Result of a goal, with a message."""

    code: ErrorCode
    message: str
    is_canceled: bool = False


@dataclass(frozen=True, eq=False)
class TrajectoryFeedback:
    """Desired and actual state of the m joints of a controller, each array (m,)."""

    time_s: float
    """Time since the start of the trajectory."""
    desired_rad: Array
    desired_rad_s: Array
    actual_rad: Array
    actual_rad_s: Array


class JointTrajectoryController(GoalController[TrajectoryGoal, GoalResult]):
    """
    Controller that moves its joints along trajectories, and holds them at the last positions.

    A new goal continues from the last target positions and velocities of the joints.

    Parameters
    ----------
    name, joints, own
        As for `GoalController`.

    """

    kind = 'joint_trajectory_controller/JointTrajectoryController'

    def __init__(self, name: str, joints: Sequence[str], own: Sequence[str]) -> None:
        super().__init__(name, joints, own)
        self.progress: TrajectoryFeedback | None = None
        """Progress of the running goal, if any."""
        self._spline: Spline | None = None
        self._start_s = 0.0
        self._hold_rad: Array | None = None

    def start(self, observation: Observation, held: JointTargets) -> None:
        """
        Start the accepted trajectory, or hold the joints if there is none.

        They are held at their last targets; after a violation of the path tolerance, at the
        positions measured then.

        Parameters
        ----------
        observation, held
            As for `Controller.start`. The trajectory starts at the time of the observation and
            continues from the held position and velocity.

        """
        self._starts = False
        hold_rad, self._hold_rad = self._hold_rad, None
        if self._goal is not None:
            self._start_s = observation.time_s
            self._spline = spline_from(self._goal.trajectory, held)
            return
        own_rad = held.positions_rad[self.indices] if hold_rad is None else hold_rad
        self._targets.positions_rad[self.indices] = own_rad
        self._targets.velocities_rad_s[self.indices] = 0.0

    def update(self, observation: Observation) -> JointTargets:
        """
        Sample the trajectory, and end the goal when it is reached or violates a tolerance.

        Parameters
        ----------
        observation
            As for `Controller.update`; its positions and velocities are compared with the
            trajectory.

        Returns
        -------
        JointTargets
            Targets of all n joints of the robot; only the entries of its own joints are valid.

        """
        if self._goal is not None and self._spline is not None:
            time_s = observation.time_s - self._start_s
            positions_rad, velocities_rad_s = self._spline.at(time_s)
            self._targets.positions_rad[self.indices] = positions_rad
            self._targets.velocities_rad_s[self.indices] = velocities_rad_s
            self.progress = TrajectoryFeedback(
                time_s,
                positions_rad,
                velocities_rad_s,
                observation.positions_rad[self.indices],
                observation.velocities_rad_s[self.indices],
            )
            self._watch(self._goal, self.progress, self._spline.end_s)
        return self._targets

    def _watch(self, goal: TrajectoryGoal, progress: TrajectoryFeedback, end_s: float) -> None:
        """End the goal once it is reached or a tolerance is violated."""
        errors = (
            progress.desired_rad - progress.actual_rad,
            progress.desired_rad_s - progress.actual_rad_s,
        )
        late_s = progress.time_s - end_s
        if late_s < 0.0:
            fault = goal.path.violation(*errors)
            if fault:
                self._end(_path_violated(fault, progress.time_s))
                self._hold_rad = progress.actual_rad
            return
        fault = goal.goal.violation(*errors)
        if not fault:
            self._end(GoalResult(ErrorCode.SUCCESSFUL, REACHED), stays=True)
        elif late_s > goal.goal_time_s:
            self._end(_goal_violated(fault, goal.goal_time_s), stays=True)

    def _ended(self, why: str, is_canceled: bool) -> GoalResult:
        """Build the result of a goal that was canceled or aborted from outside."""
        code = ErrorCode.SUCCESSFUL if is_canceled else ErrorCode.INVALID_GOAL
        return GoalResult(code, why, is_canceled)

    def _forget(self) -> None:
        """Drop the trajectory of the goal that has ended."""
        self._spline = self.progress = self._hold_rad = None


def _path_violated(fault: str, time_s: float) -> GoalResult:
    """Build the result of a goal that violated its path tolerance."""
    return GoalResult(
        ErrorCode.PATH_TOLERANCE_VIOLATED,
        f'Path tolerance violated {max(time_s, 0.0):.2f} s after the start: {fault}. The joints '
        'are held where they are.',
    )


def _goal_violated(fault: str, goal_time_s: float) -> GoalResult:
    """Build the result of a goal that was not reached in time."""
    return GoalResult(
        ErrorCode.GOAL_TOLERANCE_VIOLATED,
        f'Goal tolerance violated {goal_time_s:g} s after the end of the trajectory: {fault}. '
        'The joints are held there.',
    )


def limb_controllers(joints: Sequence[str]) -> tuple[JointTrajectoryController, ...]:
    """
    Create the trajectory controllers of the limbs of a robot.

    Parameters
    ----------
    joints
        All joints of the robot, in the order of its targets.

    """
    limbs = {
        name: [joint for joint in joints if any(part in joint for part in parts)]
        for name, parts in LIMBS.items()
    }
    return tuple(
        JointTrajectoryController(name, joints, own) for name, own in limbs.items() if own
    )
