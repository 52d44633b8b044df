# SPDX-License-Identifier: Apache-2.0
"""Gaze control: the node `gaze` with the actions `look_at` and `scan_room`."""

from __future__ import annotations

import math
import sys
from typing import Any

from control_msgs.action import PointHead
from humanoid_common.inhibition import Inhibition
from humanoid_common.node_parameters import NodeParameters
from humanoid_common.periodic import clock_s
from humanoid_common.qos import LATCHED
from humanoid_common.running import run_node
from humanoid_common.single_goal import GoalAborted, RunningGoal, SingleGoal
from humanoid_interfaces.action import ScanRoom
from humanoid_perception.gaze_parameters import GazeParameters
from humanoid_perception.head import Head
from humanoid_perception.room_scan import RoomScan
import numpy as np
from rclpy.node import Node
from std_msgs.msg import String

__all__ = ['Gaze', 'main']

_LATE_S = 5.0
"""How much longer than planned a motion of the head may take."""
_NEWS_RAD = 0.015
"""Smallest change of the joint angles for which a new motion is sent."""


class Gaze(Node):
    """
    Action server that points the head at targets and scans the surroundings.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('gaze', **options)
        self.parameters = NodeParameters(self, GazeParameters)
        told = self.parameters.current
        self._inhibition = Inhibition()
        self._head = Head(self, told.joints, told.controller)
        self._goals = SingleGoal(self, lambda: self._inhibition.reason)
        scan = RoomScan(self, self._head, self._goals, self.parameters)
        self._goals.offer(PointHead, 'look_at', self._look_at, _unsound)
        self._goals.offer(ScanRoom, 'scan_room', scan.work)
        for topic, take in (
            ('walking_state', self._inhibition.tell_walking_state),
            ('stop_state', self._inhibition.tell_stop_state),
        ):
            self.create_subscription(
                String, topic, lambda message, tell=take: tell(message.data), LATCHED
            )

    async def _look_at(self, goal: RunningGoal) -> None:
        with self._head.listening():
            try:
                await self._track(goal)
            except BaseException:
                self._head.stop()
                raise

    async def _track(self, goal: RunningGoal) -> None:
        """Track the target with the head until the pointing error is within the tolerance."""
        request, told, head = goal.request, self.parameters.current, self._head
        await head.wait(goal)
        frame, source = request.pointing_frame or told.camera_frame, request.target.header.frame_id
        tip = await head.known(goal, head.chain.tip_frame, frame)
        await head.known(goal, head.chain.base_frame, source)
        axis = _vector(request.pointing_axis)
        axis = axis / np.linalg.norm(axis) if axis.any() else np.array([0.0, 0.0, 1.0])
        point = np.append(_vector(request.target.point), 1.0)
        at_least_s = request.min_duration.sec + request.min_duration.nanosec * 1e-9
        fastest = min(request.max_velocity or told.max_velocity, told.max_velocity)
        begin_s, sent, end_s, ticks = clock_s(self), None, math.inf, 0
        while True:
            now_s = clock_s(self)
            begin_s = min(begin_s, now_s)  # the simulation may have been reset
            target = (head.pose(head.chain.base_frame, source) @ point)[:3]
            angles = head.angles_rad()
            error_rad = head.chain.error_rad(angles, target, tip, axis)
            goal.publish_feedback(PointHead.Feedback(pointing_angle_error=error_rad))
            is_over = now_s - begin_s >= at_least_s
            if is_over and error_rad <= told.tolerance_rad:
                return
            if ticks % 4 == 0:
                start = angles if sent is None else sent.angles_rad
                aim = head.chain.aim(target, tip, axis, start)
                if sent is None or np.abs(aim.angles_rad - sent.angles_rad).max() > _NEWS_RAD:
                    first_s = at_least_s if sent is None else 0.0
                    duration_s = head.duration_s(aim.angles_rad, fastest, first_s)
                    head.send(aim.angles_rad, duration_s)
                    end_s, sent = now_s + duration_s + _LATE_S, aim
            assert sent is not None
            has_arrived = head.has_arrived()
            if is_over and has_arrived and sent.error_rad > told.tolerance_rad:
                raise GoalAborted(
                    'UNKNOWN',
                    'The head cannot turn that far: at its limit it points '
                    f'{math.degrees(error_rad):.0f} degrees off the target. Turn the body '
                    'towards it first.',
                )
            if now_s > max(end_s, begin_s + at_least_s + _LATE_S):
                raise GoalAborted(
                    'HEAD_FAILED',
                    f'The head did not get closer than {error_rad:.2f} rad to the target.',
                )
            ticks += 1
            await goal.tick()


def _vector(message: Any) -> Any:
    return np.array([message.x, message.y, message.z])


def _unsound(request: PointHead.Goal) -> str:
    """Validate a goal of `look_at`; return the rejection message, or an empty string."""
    numbers = (*_vector(request.target.point), *_vector(request.pointing_axis))
    if not all(map(math.isfinite, (*numbers, request.max_velocity))):
        return 'It has a value that is not finite.'
    if request.max_velocity < 0.0:
        return 'max_velocity is negative. Give rad/s, or 0 for the default.'
    if not request.target.header.frame_id:
        return 'The target has no frame_id. Give the frame of the point, such as map.'
    return ''


def main(args: list[str] | None = None) -> int:
    """
    Run the node `gaze`.

    Parameters
    ----------
    args : list[str] | None
        The command line with its ROS arguments; None for that of the process.

    Returns
    -------
    int
        The exit status: 1 if the node cannot start, else 0.

    """
    return run_node(Gaze, args)


if __name__ == '__main__':
    sys.exit(main())
