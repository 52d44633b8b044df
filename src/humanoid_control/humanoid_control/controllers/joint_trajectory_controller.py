# SPDX-License-Identifier: Apache-2.0
"""Follow trajectories that are goals: watch the way, say how it ended, and hold the last pose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum

from humanoid_control.backends import Array, JointTargets, Observation
from humanoid_control.controllers.goal_controller import GoalController
from humanoid_control.controllers.spline import Spline
from humanoid_control.controllers.trajectory_goal import TrajectoryGoal
from humanoid_control.controllers.trajectory_runner import spline_from

REACHED = 'Goal reached.'


class ErrorCode(IntEnum):
    """How a goal ended, with the numbers of control_msgs/action/FollowJointTrajectory."""

    SUCCESSFUL = 0
    INVALID_GOAL = -1
    INVALID_JOINTS = -2
    OLD_HEADER_TIMESTAMP = -3
    PATH_TOLERANCE_VIOLATED = -4
    GOAL_TOLERANCE_VIOLATED = -5


@dataclass(frozen=True)
class GoalResult:
    """The end of a goal, with a sentence on it."""

    code: ErrorCode
    message: str
    is_canceled: bool = False


@dataclass(frozen=True, eq=False)
class Progress:
    """Where the m joints of a controller should be and are, each array (m,)."""

    time_s: float
    """Since the start of the trajectory."""
    desired_rad: Array
    desired_rad_s: Array
    actual_rad: Array
    actual_rad_s: Array


class JointTrajectoryController(GoalController[TrajectoryGoal, GoalResult]):
    """
    Controller that moves its joints along trajectories, and holds them in the last pose.

    A new goal goes on from the position and the velocity that the joints were told last.

    Parameters
    ----------
    name, joints, own
        As for `GoalController`.

    """

    kind = 'joint_trajectory_controller/JointTrajectoryController'

    def __init__(self, name: str, joints: Sequence[str], own: Sequence[str]) -> None:
        super().__init__(name, joints, own)
        self.progress: Progress | None = None
        """Of the goal that runs."""
        self._spline: Spline | None = None
        self._start_s = 0.0
        self._hold_rad: Array | None = None

    def start(self, observation: Observation, held: JointTargets) -> None:
        """
        Start the accepted trajectory, or hold the joints if there is none.

        They are held at their last targets; after a violation of the path tolerance, where they
        were measured then.

        Parameters
        ----------
        observation, held
            As for `Controller.start`. The trajectory begins at the time of the observation and
            goes on from the held position and velocity.

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
            Of all n joints of the robot; only the entries of its own joints mean something.

        """
        if self._goal is not None and self._spline is not None:
            time_s = observation.time_s - self._start_s
            positions_rad, velocities_rad_s = self._spline.at(time_s)
            self._targets.positions_rad[self.indices] = positions_rad
            self._targets.velocities_rad_s[self.indices] = velocities_rad_s
            self.progress = Progress(
                time_s,
                positions_rad,
                velocities_rad_s,
                observation.positions_rad[self.indices],
                observation.velocities_rad_s[self.indices],
            )
            self._watch(self._goal, self.progress, self._spline.end_s)
        return self._targets

    def _watch(self, goal: TrajectoryGoal, progress: Progress, end_s: float) -> None:
        """End a goal that is reached, or whose tolerances are violated."""
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
        """Return the result of a goal that is ended from outside."""
        code = ErrorCode.SUCCESSFUL if is_canceled else ErrorCode.INVALID_GOAL
        return GoalResult(code, why, is_canceled)

    def _forget(self) -> None:
        """Drop the way of the goal that has ended."""
        self._spline = self.progress = self._hold_rad = None


def _path_violated(fault: str, time_s: float) -> GoalResult:
    """Return the end of a goal that leaves its path."""
    return GoalResult(
        ErrorCode.PATH_TOLERANCE_VIOLATED,
        f'Path tolerance violated {max(time_s, 0.0):.2f} s after the start: {fault}. The joints '
        'are held where they are.',
    )


def _goal_violated(fault: str, goal_time_s: float) -> GoalResult:
    """Return the end of a goal that is not reached in time."""
    return GoalResult(
        ErrorCode.GOAL_TOLERANCE_VIOLATED,
        f'Goal tolerance violated {goal_time_s:g} s after the end of the trajectory: {fault}. '
        'The joints are held there.',
    )
