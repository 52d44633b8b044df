# SPDX-License-Identifier: Apache-2.0
"""A client of `follow_joint_trajectory`, for tests."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from humanoid_common.testing.ros import RosSandbox
from rclpy.action import ActionClient
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

PATIENCE_S = 100.0
"""How long an answer may take on a busy computer."""


class TrajectoryClient:
    """A client of the action of one controller."""

    def __init__(self, ros: RosSandbox, name: str) -> None:
        """Find the server."""
        self.ros, self.node = ros, ros.observer()
        self.feedback: list[Any] = []
        self._client = ActionClient(self.node, FollowJointTrajectory, name)
        ros.wait_until(self._client.server_is_ready, PATIENCE_S, name)

    def wait(self, future: Any, what: str) -> Any:
        """Return what a future brings."""
        self.ros.wait_until(future.done, PATIENCE_S, what)
        return future.result()

    def send(self, goal: FollowJointTrajectory.Goal) -> Any:
        """Return the handle of a goal."""
        future = self._client.send_goal_async(
            goal, lambda message: self.feedback.append(message.feedback)
        )
        return self.wait(future, 'an answer to a goal')

    def end_of(self, handle: Any) -> tuple[int, FollowJointTrajectory.Result]:
        """Return the status with which a goal ends, and its result."""
        assert handle.accepted
        answer = self.wait(handle.get_result_async(), 'the end of a goal')
        return answer.status, answer.result

    def close(self) -> None:
        """End."""
        self._client.destroy()


def trajectory_goal(
    joints: Sequence[str], *points: tuple[float, Sequence[float]], **fields: Any
) -> FollowJointTrajectory.Goal:
    """
    Return the goal of a trajectory.

    Parameters
    ----------
    joints
        The names of the joints.
    points
        Times since the start, in seconds, and positions of the joints.
    fields
        Other fields of the goal, such as tolerances.

    """
    way = [
        JointTrajectoryPoint(
            positions=list(map(float, positions)),
            time_from_start=Duration(sec=int(time_s), nanosec=round(time_s % 1 * 1e9)),
        )
        for time_s, positions in points
    ]
    trajectory = JointTrajectory(joint_names=list(joints), points=way)
    return FollowJointTrajectory.Goal(trajectory=trajectory, **fields)
