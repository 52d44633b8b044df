# SPDX-License-Identifier: Apache-2.0
"""The actions by which arms and head are moved along trajectories."""

from __future__ import annotations

from collections.abc import Sequence
import math
from typing import Any

from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from humanoid_control.backends import Array
from humanoid_control.controllers import (
    CommandError,
    GoalResult,
    JointTolerance,
    JointTrajectoryController,
    TrajectoryGoal,
    TrajectoryRequest,
)
from humanoid_control.hosting.conversions import points_of, seconds
from humanoid_control.hosting.every import Every
from humanoid_control.hosting.refusals import Refusals
from humanoid_control.hosting.robot_control import RobotControl
from humanoid_control.hosting.topics.filling import fill_stamp, topic
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.node import Node
from rclpy.task import Future
from trajectory_msgs.msg import JointTrajectoryPoint

ACTION = 'follow_joint_trajectory'
FEEDBACK_RATE_HZ = 20.0


class FollowJointTrajectoryServers:
    """Offers `follow_joint_trajectory` below the name of each controller of a robot."""

    def __init__(self, node: Node, robot: str, control: RobotControl) -> None:
        """Offer the actions of a robot that has a name, or is alone."""
        refusals = Refusals(node.get_logger().warning)
        self._servers = [
            _Server(node, topic(robot, f'{name}/{ACTION}'), control, controller, refusals)
            for name, controller in control.controllers.items()
        ]
        self._due = Every(FEEDBACK_RATE_HZ)

    def tell(self, time_s: float) -> None:
        """Take note of the robot's time; publish how goals go, if it is time."""
        is_due = self._due.is_due(time_s)
        for server in self._servers:
            server.time_s = time_s
            if is_due:
                server.publish_feedback()


class _Server:
    """The action of one controller."""

    def __init__(
        self,
        node: Node,
        name: str,
        control: RobotControl,
        controller: JointTrajectoryController,
        refusals: Refusals,
    ) -> None:
        self._node, self._name = node, name
        self._control, self._controller = control, controller
        self._refusals = refusals
        self._checked: TrajectoryGoal | None = None
        self._current: ServerGoalHandle | None = None
        self._ends: dict[bytes, Future] = {}
        self.time_s = 0.0
        """The robot's time."""
        self._server = ActionServer(
            node,
            FollowJointTrajectory,
            name,
            self._execute,
            goal_callback=self._check,
            handle_accepted_callback=self._start,
            cancel_callback=self._cancel,
        )

    def publish_feedback(self) -> None:
        """Say where the joints should be and are, if a goal runs."""
        progress, goal = self._controller.progress, self._current
        if progress is None or goal is None:
            return
        feedback = FollowJointTrajectory.Feedback(joint_names=self._controller.own)
        fill_stamp(feedback.header.stamp, self.time_s)
        desired, actual = progress.desired_rad, progress.actual_rad
        desired_speed, actual_speed = progress.desired_rad_s, progress.actual_rad_s
        feedback.desired = _point(progress.time_s, desired, desired_speed)
        feedback.actual = _point(progress.time_s, actual, actual_speed)
        feedback.error = _point(progress.time_s, desired - actual, desired_speed - actual_speed)
        goal.publish_feedback(feedback)

    def _check(self, goal: FollowJointTrajectory.Goal) -> GoalResponse:
        """Accept a goal that can be done; say why another is rejected."""
        try:
            request = _request(goal, self.time_s)
            self._checked = self._control.checked_goal(self._controller.name, request)
        except CommandError as error:
            self._refusals.add(f"Rejected a goal of '{self._name}'. {error}")
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def _start(self, handle: ServerGoalHandle) -> None:
        """Give the goal that was just checked to the controller."""
        if self._checked is None:
            raise RuntimeError('A goal was accepted that was not checked.')
        end = self._ends[bytes(handle.goal_id.uuid)] = Future(executor=self._node.executor)
        self._controller.accept(self._checked, end.set_result)
        self._checked, self._current = None, handle
        handle.execute()

    async def _execute(self, handle: ServerGoalHandle) -> Any:
        """Wait for the end of a goal, and say how it ended."""
        goal_id = bytes(handle.goal_id.uuid)
        end: GoalResult = await self._ends[goal_id]
        del self._ends[goal_id]
        if self._current is handle:
            self._current = None
        if end.is_canceled:
            handle.canceled()
        elif end.code:
            handle.abort()
            self._node.get_logger().warning(f"Aborted a goal of '{self._name}'. {end.message}")
        else:
            handle.succeed()
        return FollowJointTrajectory.Result(error_code=int(end.code), error_string=end.message)

    def _cancel(self, handle: ServerGoalHandle) -> CancelResponse:
        """End a goal as its client asks, unless it has ended meanwhile."""
        end = self._ends.get(bytes(handle.goal_id.uuid))
        if end is None or end.done():
            return CancelResponse.REJECT
        self._controller.cancel_goal()
        return CancelResponse.ACCEPT


def _request(goal: FollowJointTrajectory.Goal, now_s: float) -> TrajectoryRequest:
    """Return what a goal asks for, at a time of the robot; refuse what no controller can do."""
    if goal.multi_dof_trajectory.points or goal.multi_dof_trajectory.joint_names:
        raise CommandError(
            'It has a multi_dof_trajectory, but all joints here have one degree of freedom. Give '
            'a trajectory instead.'
        )
    if goal.component_path_tolerance or goal.component_goal_tolerance:
        raise CommandError(
            'It has tolerances of components, which belong to joints of several degrees of '
            'freedom. Give path_tolerance and goal_tolerance instead.'
        )
    start_s = seconds(goal.trajectory.header.stamp)
    return TrajectoryRequest(
        goal.trajectory.joint_names,
        points_of(goal.trajectory),
        _tolerances(goal.path_tolerance),
        _tolerances(goal.goal_tolerance),
        seconds(goal.goal_time_tolerance),
        start_s - now_s if start_s else 0.0,
    )


def _tolerances(given: Sequence[Any]) -> list[JointTolerance]:
    """Return the tolerances of messages."""
    return [JointTolerance(each.name, each.position, each.velocity) for each in given]


def _point(time_s: float, positions_rad: Array, velocities_rad_s: Array) -> JointTrajectoryPoint:
    """Return the message of a state of the joints."""
    whole_s = math.floor(time_s)
    return JointTrajectoryPoint(
        positions=positions_rad,
        velocities=velocities_rad_s,
        time_from_start=Duration(sec=whole_s, nanosec=int((time_s - whole_s) * 1e9)),
    )
