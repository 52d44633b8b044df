# SPDX-License-Identifier: Apache-2.0
"""Client of the action of a joint trajectory controller."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from control_msgs.msg import JointTolerance
from humanoid_common.client_goals import cancel_goal, ResultRequest
from humanoid_common.goal_guard import GoalGuard, GuardedActionClient
from humanoid_common.single_goal import GoalAborted
from rclpy.action import ActionClient
from rclpy.node import Node
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

__all__ = ['JointMover', 'trajectory_point']

_OFF = (
    FollowJointTrajectory.Result.PATH_TOLERANCE_VIOLATED,
    FollowJointTrajectory.Result.GOAL_TOLERANCE_VIOLATED,
)
"""Error codes of a motion that was obstructed."""


def trajectory_point(
    time_s: float, positions: Sequence[float], velocities: Sequence[float] = ()
) -> JointTrajectoryPoint:
    """
    Build a trajectory point.

    Parameters
    ----------
    time_s
        Time from the start of the trajectory.
    positions, velocities
        Of each joint in rad and rad/s, or m and m/s; velocities are optional.

    """
    return JointTrajectoryPoint(
        positions=[float(each) for each in positions],
        velocities=[float(each) for each in velocities],
        time_from_start=_duration(time_s),
    )


def _duration(seconds: float) -> Duration:
    return Duration(sec=int(seconds), nanosec=int(seconds % 1.0 * 1e9))


class JointMover:
    """
    Client that sends one motion after another to a joint trajectory controller.

    Parameters
    ----------
    node
        The node of the action client.
    joints
        The names of all joints of the controller.
    controller
        Name of the controller.
    code, blocked
        Names of the error codes of goals that fail because of the controller, and of goals whose
        joints do not reach their targets; by default the same.
    guard
        Cancels the motion when this process ends; without one, the motion continues.

    """

    def __init__(
        self,
        node: Node,
        joints: Sequence[str],
        controller: str,
        code: str,
        blocked: str = '',
        guard: GoalGuard | None = None,
    ) -> None:
        self.joints, self._code, self._blocked = list(joints), code, blocked or code
        self.action = f'{controller}/follow_joint_trajectory'
        self._client = (
            ActionClient(node, FollowJointTrajectory, self.action)
            if guard is None
            else GuardedActionClient(guard, FollowJointTrajectory, self.action)
        )
        self._sent: Any = None
        self._handle: Any = None
        self._end: ResultRequest | None = None

    @property
    def is_ready(self) -> bool:
        """Whether the controller is available."""
        return bool(self._client.server_is_ready())

    def send(
        self,
        points: Sequence[JointTrajectoryPoint],
        path_tolerance_rad: float = 0.0,
        goal_time_s: float = 0.0,
    ) -> None:
        """
        Start a motion, which replaces the one that is still running.

        Parameters
        ----------
        points
            The trajectory points.
        path_tolerance_rad
            Path tolerance of each joint; 0 is any error.
        goal_time_s
            Goal time tolerance; 0 is any time.

        """
        goal = FollowJointTrajectory.Goal(
            trajectory=JointTrajectory(joint_names=self.joints, points=list(points)),
            goal_time_tolerance=_duration(goal_time_s),
        )
        if path_tolerance_rad:
            goal.path_tolerance = [
                JointTolerance(name=joint, position=path_tolerance_rad) for joint in self.joints
            ]
        self._handle = self._end = None
        sent = self._sent = self._client.send_goal_async(goal)

        def take(future: Any) -> None:
            handle = future.result()
            if sent is self._sent:
                self._handle = handle
                if handle.accepted:
                    self._end = ResultRequest(handle)
            else:
                cancel_goal(sent)

        sent.add_done_callback(take)

    def has_arrived(self) -> bool:
        """
        Check whether the last motion has reached its end.

        Raises
        ------
        GoalAborted
            The controller rejected or aborted it.

        """
        if self._handle is not None and not self._handle.accepted:
            raise GoalAborted(
                self._code,
                f"'{self.action}' rejected the motion. See the log of the robot for the reason.",
            )
        if self._end is None or not self._end.done():
            return False
        answer = self._end.result()
        if answer.status != GoalStatus.STATUS_SUCCEEDED:
            reason = answer.result.error_string or 'another client is moving these joints'
            is_off = answer.result.error_code in _OFF
            raise GoalAborted(
                self._blocked if is_off else self._code,
                f"'{self.action}' ended the motion: {reason}",
            )
        return True

    def stop(self) -> None:
        """Cancel the running motion, if any; the joints stay where they are."""
        if self._end is not None and not self._end.done():
            cancel_goal(self._sent)
        self._sent = self._handle = self._end = None
