# SPDX-License-Identifier: Apache-2.0
"""Move the robot to a stance: by navigation, by steps, and by bending the body."""

from __future__ import annotations

import math

from action_msgs.msg import GoalStatus
from geometry_msgs.msg import Pose, Twist
from humanoid_common.goal_guard import GoalGuard, GuardedActionClient
from humanoid_common.periodic import clock_s
from humanoid_common.qos import COMMAND
from humanoid_common.single_goal import GoalAborted, RunningGoal
from humanoid_description.robot import Array
from humanoid_description.rotations import yaw_of
from humanoid_manipulation.stances import Bend
from humanoid_perception.transforms import Transforms
from nav2_msgs.action import NavigateToPose
import numpy as np
from rclpy.node import Node

__all__ = ['Feet']

_CODE = 'WALK_FAILED'
_NEAR_M, _NEAR_RAD = 0.035, 0.06
"""Position and heading tolerances of a stance."""
_GAIN_1_S = 0.9
_FASTEST = (0.15, 0.08, 0.35)
"""Velocity limits: forward and sideways in m/s, turning in rad/s."""
_STUCK_S, _PROGRESS_M, _LEVER_M = 4.0, 0.01, 0.2
"""The robot is stuck if its error does not decrease by this distance within this time; a turn by
1 rad counts as much as the lever."""
_STUCK = 'I cannot get any closer than %.0f cm: something may be in my way.'
_SETTLE_S = 1.0
_BEND_S = 6.0
_BENT_RAD = 0.04


class Feet:
    """
    Interface to walking, navigation and the body pose.

    Parameters
    ----------
    node
        The node that publishes the commands.
    transforms
        The transform listener.
    base_frame
        The frame of the pelvis.
    guard
        Cancels navigation goals when this process ends.

    """

    def __init__(
        self, node: Node, transforms: Transforms, base_frame: str, guard: GoalGuard
    ) -> None:
        self._node, self._transforms, self._base = node, transforms, base_frame
        prefix = base_frame.removesuffix('base_link')
        self.soles = [prefix + sole for sole in ('l_sole', 'r_sole')]
        self._velocities = node.create_publisher(Twist, 'cmd_vel', COMMAND)
        self._poses = node.create_publisher(Pose, 'body_pose', COMMAND)
        self._navigate = GuardedActionClient(guard, NavigateToPose, 'navigate_to_pose')

    def place(self, frame: str) -> tuple[float, float, float]:
        """
        Compute where the robot stands: the midpoint of its soles, and its heading.

        The pelvis is no reference: it sways while the robot steps, and moves back when it bends.

        Parameters
        ----------
        frame
            The frame of the result, such as map or odom.

        Returns
        -------
        tuple
            x and y in m, and the heading in rad, the mean of those of the soles.

        Raises
        ------
        GoalAborted
            The transform of a sole is not available.

        """
        soles = [self._transforms.pose(frame, sole) for sole in self.soles]
        middle = (soles[0][:3, 3] + soles[1][:3, 3]) / 2.0
        left_rad, right_rad = (yaw_of(sole[:3, :3]) for sole in soles)
        turn_rad = math.remainder(left_rad - right_rad, math.tau)
        return float(middle[0]), float(middle[1]), right_rad + turn_rad / 2.0

    async def go(self, goal: RunningGoal, frame: str, at: tuple[float, float, float]) -> None:
        """
        Navigate to a pose; the robot stops near it.

        Parameters
        ----------
        goal
            The goal.
        frame, at
            The pose: x and y in m, yaw in rad, in a frame.

        Raises
        ------
        GoalAborted
            Navigation is not available, or does not succeed: WALK_FAILED.
        GoalCanceled
            The goal is canceled; so is navigation.

        """
        wanted = NavigateToPose.Goal()
        wanted.pose.header.frame_id = frame
        pose = wanted.pose.pose
        pose.position.x, pose.position.y = at[0], at[1]
        pose.orientation.w, pose.orientation.z = math.cos(at[2] / 2.0), math.sin(at[2] / 2.0)
        answer = await goal.delegate(self._navigate, wanted, 'navigate_to_pose', _CODE)
        if answer.status != GoalStatus.STATUS_SUCCEEDED:
            reason = answer.result.error_msg or 'navigation did not succeed'
            raise GoalAborted(_CODE, f'I could not get there: {reason}')

    async def step_to(self, goal: RunningGoal, frame: str, at: tuple[float, float, float]) -> None:
        """
        Step straight to a pose, to within centimetres.

        Parameters
        ----------
        goal
            The goal.
        frame, at
            The pose: x and y in m, yaw in rad, in a frame.

        Raises
        ------
        GoalAborted
            The robot no longer gets nearer: WALK_FAILED.
        GoalCanceled
            The goal is canceled.

        """
        # In odom the target does not jump, as it may in the map.
        shift = await self._transforms.known(goal, 'odom', frame)
        place = shift[:3, :3] @ np.array([at[0], at[1], 0.0]) + shift[:3, 3]
        yaw_rad = at[2] + yaw_of(shift[:3, :3])
        until_s = clock_s(self._node) + _STUCK_S
        least = math.inf
        try:
            calm = 0
            while calm < _SETTLE_S * 20.0:
                error = self._error(place, yaw_rad)
                away = math.hypot(error[0], error[1]) + _LEVER_M * abs(error[2])
                if away < least - _PROGRESS_M:
                    least, until_s = away, clock_s(self._node) + _STUCK_S
                is_near = math.hypot(error[0], error[1]) < _NEAR_M and abs(error[2]) < _NEAR_RAD
                calm = calm + 1 if is_near else 0
                command = Twist()
                if not is_near:
                    if clock_s(self._node) > until_s:
                        raise GoalAborted(_CODE, _STUCK % (100.0 * away))
                    speeds = [
                        max(-most, min(most, _GAIN_1_S * each))
                        for each, most in zip(error, _FASTEST)
                    ]
                    command.linear.x, command.linear.y, command.angular.z = speeds
                self._velocities.publish(command)
                await goal.tick()
        finally:
            self._velocities.publish(Twist())

    async def bend(self, goal: RunningGoal, bend: Bend) -> None:
        """
        Bend the body, and wait until its pitch has settled; the height is not checked.

        Parameters
        ----------
        goal
            The goal.
        bend
            The pitch and height to publish on `body_pose`.

        Raises
        ------
        GoalAborted
            The pitch does not settle within 6 s: WALK_FAILED.
        GoalCanceled
            The goal is canceled.

        """
        message = Pose()
        message.position.z = bend.height_m
        message.orientation.w = math.cos(bend.pitch_rad / 2.0)
        message.orientation.y = math.sin(bend.pitch_rad / 2.0)
        until_s = clock_s(self._node) + _BEND_S
        calm = 0
        while calm < _SETTLE_S * 20.0:
            if clock_s(self._node) > until_s:
                raise GoalAborted(_CODE, 'I could not bend that far.')
            self._poses.publish(message)
            pitch_rad = -math.asin(
                float(np.clip(self._transforms.pose('odom', self._base)[2, 0], -1.0, 1.0))
            )
            calm = calm + 1 if abs(pitch_rad - bend.pitch_rad) < _BENT_RAD else 0
            await goal.tick()

    def straighten(self) -> None:
        """Command the upright body pose, without waiting."""
        self._poses.publish(Pose())

    def _error(self, place: Array, yaw_rad: float) -> tuple[float, float, float]:
        """Compute the remaining error: forward, to the left, and in heading."""
        x_m, y_m, heading_rad = self.place('odom')
        dx, dy = float(place[0]) - x_m, float(place[1]) - y_m
        c, s = math.cos(heading_rad), math.sin(heading_rad)
        turn_rad = math.remainder(yaw_rad - heading_rad, math.tau)
        return c * dx + s * dy, -s * dx + c * dy, turn_rad
