# SPDX-License-Identifier: Apache-2.0
"""Action servers of the controllers: joint trajectories and gripper commands."""

from __future__ import annotations

from collections.abc import Sequence
import math
from typing import Any

from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory, GripperCommand
from humanoid_control.backends import Array
from humanoid_control.controllers import (
    CommandError,
    GoalResult,
    Grip,
    GripperController,
    GripResult,
    GripState,
    JointTolerance,
    JointTrajectoryController,
    TrajectoryGoal,
    TrajectoryRequest,
)
from humanoid_control.hosting.conversions import points_of, seconds
from humanoid_control.hosting.goal_server import FEEDBACK_RATE_HZ, GoalServer
from humanoid_control.hosting.pacing import RateLimiter
from humanoid_control.hosting.reports import Refusals
from humanoid_control.hosting.robot_control import RobotControl
from humanoid_control.hosting.topics.filling import fill_stamp, topic
from rclpy.action.server import ServerGoalHandle
from rclpy.node import Node
from trajectory_msgs.msg import JointTrajectoryPoint


class ControllerActions:
    """
    Action servers `follow_joint_trajectory` and `gripper_cmd`, in the controller namespaces.

    Parameters
    ----------
    node
        The node that offers them.
    robot
        Name of the robot, which is its namespace; empty if it is alone.
    control
        The control of the robot, whose controllers run the goals.

    """

    def __init__(self, node: Node, robot: str, control: RobotControl) -> None:
        refusals = Refusals(node.get_logger().warning)
        self._servers: list[GoalServer[Any, Any]] = []
        for name, limb in control.goals.limbs.items():
            action = topic(robot, f'{name}/follow_joint_trajectory')
            self._servers.append(
                FollowJointTrajectoryServer(node, action, control, limb, refusals)
            )
        for name, gripper in control.goals.grippers.items():
            action = topic(robot, f'{name}/gripper_cmd')
            self._servers.append(GripperCommandServer(node, action, control, gripper, refusals))
        self._due = RateLimiter(FEEDBACK_RATE_HZ)

    def tell(self, time_s: float) -> None:
        """
        Update the time of the action servers, and publish feedback of their goals at its rate.

        Parameters
        ----------
        time_s
            The robot's time, that of the newest observation.

        """
        is_due = self._due.is_due(time_s)
        for server in self._servers:
            server.time_s = time_s
            if is_due:
                server.publish_feedback()


class FollowJointTrajectoryServer(GoalServer[TrajectoryGoal, GoalResult]):
    """
    Action server of one joint trajectory controller; see `GoalServer`.

    Parameters
    ----------
    node, name
        The node that offers the action, and the name of the action.
    control
        The control of the robot, which checks goals.
    controller
        Runs the goals.
    refusals
        Receives a message on each goal that is rejected.

    """

    def __init__(
        self,
        node: Node,
        name: str,
        control: RobotControl,
        controller: JointTrajectoryController,
        refusals: Refusals,
    ) -> None:
        super().__init__(node, FollowJointTrajectory, name, controller, refusals)
        self._control, self._controller = control, controller

    def publish_feedback(self) -> None:
        """Publish the desired and actual joint states and their error, if a goal is running."""
        progress, goal = self._controller.progress, self.current
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

    def checked(self, goal: FollowJointTrajectory.Goal) -> TrajectoryGoal:
        """
        Check a FollowJointTrajectory goal against the joints and limits of the controller.

        Parameters
        ----------
        goal
            The trajectory and its tolerances. If the stamp of its header is zero, it starts now.

        Returns
        -------
        TrajectoryGoal
            As for `GoalServer.checked`.

        Raises
        ------
        CommandError
            As for `GoalServer.checked`.

        """
        request = _request(goal, self.time_s)
        return self._control.goals.checked_goal(self._controller.name, request)

    def finished(self, handle: ServerGoalHandle, end: GoalResult) -> tuple[Any, str]:
        """
        Set the status of a goal that has ended, and build its FollowJointTrajectory result.

        Parameters
        ----------
        handle, end
            As for `GoalServer.finished`; an error code other than zero aborts the goal.

        Returns
        -------
        tuple
            As for `GoalServer.finished`.

        """
        trouble = ''
        if end.is_canceled:
            handle.canceled()
        elif end.code:
            handle.abort()
            trouble = end.message
        else:
            handle.succeed()
        result = FollowJointTrajectory.Result(error_code=int(end.code), error_string=end.message)
        return result, trouble


def _request(goal: FollowJointTrajectory.Goal, now_s: float) -> TrajectoryRequest:
    """Convert a goal to a request at the robot's time; reject unsupported fields."""
    if goal.multi_dof_trajectory.points or goal.multi_dof_trajectory.joint_names:
        raise CommandError(
            'It has a multi_dof_trajectory, but all joints here have one degree of freedom. Give '
            'a trajectory instead.'
        )
    if goal.component_path_tolerance or goal.component_goal_tolerance:
        raise CommandError(
            'It has component tolerances, which are for joints with several degrees of '
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
    """Convert JointTolerance messages."""
    return [JointTolerance(each.name, each.position, each.velocity) for each in given]


def _point(time_s: float, positions_rad: Array, velocities_rad_s: Array) -> JointTrajectoryPoint:
    """Build the trajectory point message of a joint state."""
    whole_s = math.floor(time_s)
    return JointTrajectoryPoint(
        positions=positions_rad,
        velocities=velocities_rad_s,
        time_from_start=Duration(sec=whole_s, nanosec=int((time_s - whole_s) * 1e9)),
    )


class GripperCommandServer(GoalServer[Grip, GripResult]):
    """
    Action server of one gripper; see `GoalServer`.

    A position is the gap between the fingers in m, an effort the force of the actuator in N. A
    goal succeeds if the gap is reached, and also if the fingers stop before, on an object:
    `stalled` reports which of the two it was, and `position` the final gap.

    Parameters
    ----------
    node, name
        The node that offers the action, and the name of the action.
    control
        The control of the robot, which checks goals.
    controller
        Runs the goals.
    refusals
        Receives a message on each goal that is rejected.

    """

    def __init__(
        self,
        node: Node,
        name: str,
        control: RobotControl,
        controller: GripperController,
        refusals: Refusals,
    ) -> None:
        super().__init__(node, GripperCommand, name, controller, refusals)
        self._control, self._controller = control, controller

    def publish_feedback(self) -> None:
        """Publish the state of the gripper, if a goal is running."""
        if self.current is not None and self._controller.has_goal:
            feedback = GripperCommand.Feedback()
            self.current.publish_feedback(_filled(feedback, self._controller.state))

    def checked(self, goal: GripperCommand.Goal) -> Grip:
        """
        Check a GripperCommand goal against the range of the gripper.

        Parameters
        ----------
        goal
            Its `position` is the gap between the fingers in m, its `max_effort` the maximum force
            in N; 0 is that of the actuator.

        Returns
        -------
        Grip
            As for `GoalServer.checked`.

        Raises
        ------
        CommandError
            As for `GoalServer.checked`.

        """
        command = goal.command
        return self._control.goals.checked_grip(
            self._controller.name, command.position, command.max_effort
        )

    def finished(self, handle: ServerGoalHandle, end: GripResult) -> tuple[Any, str]:
        """
        Set the status of a goal that has ended, and build its GripperCommand result.

        Parameters
        ----------
        handle, end
            As for `GoalServer.finished`; fingers that stall on an object succeed as well.

        Returns
        -------
        tuple
            As for `GoalServer.finished`.

        """
        trouble = ''
        if end.is_canceled:
            handle.canceled()
        elif end.has_ended_well:
            handle.succeed()
        else:
            handle.abort()
            trouble = end.message
        return _filled(GripperCommand.Result(), end.state), trouble


def _filled(message: Any, state: GripState) -> Any:
    """Fill a message with the state of a gripper."""
    message.position, message.effort = state.gap_m, state.effort_n
    message.stalled, message.reached_goal = state.stalled, state.reached_goal
    return message
