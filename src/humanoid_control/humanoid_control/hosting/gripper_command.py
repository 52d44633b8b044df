# SPDX-License-Identifier: Apache-2.0
"""Action servers `gripper_cmd` of the gripper controllers."""

from __future__ import annotations

from typing import Any

from control_msgs.action import GripperCommand
from humanoid_control.controllers import Grip, GripperController, GripResult, GripState
from humanoid_control.hosting.goal_server import GoalServer
from humanoid_control.hosting.refusals import Refusals
from humanoid_control.hosting.robot_control import RobotControl
from rclpy.action.server import ServerGoalHandle
from rclpy.node import Node


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
        return self._control.checked_grip(
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
