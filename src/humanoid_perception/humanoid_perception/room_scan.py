# SPDX-License-Identifier: Apache-2.0
"""Scan a room: sweep the head, and turn the body between sweeps."""

from __future__ import annotations

import math
from typing import Any

from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Twist
from humanoid_common.node_parameters import NodeParameters
from humanoid_common.periodic import clock_s
from humanoid_common.qos import COMMAND, SENSOR, STATE
from humanoid_common.single_goal import GoalAborted, RunningGoal, SingleGoal
from humanoid_description.rotations import yaw_of
from humanoid_interfaces.action import ScanRoom
from humanoid_interfaces.srv import FindObjects
from humanoid_perception.frames import stamp_in
from humanoid_perception.gaze_parameters import GazeParameters
from humanoid_perception.head import Head
from humanoid_perception.scanning import Coverage, FieldOfView, head_sweep, stances
from nav2_msgs.action import Spin
import numpy as np
from rclpy.action import ActionClient
from rclpy.node import Node
from sensor_msgs.msg import CameraInfo
from vision_msgs.msg import Detection3DArray

__all__ = ['RoomScan']

_LATE_S = 5.0
_SETTLED_S = 0.3
"""Time for the camera to stop shaking after a motion."""
_BLIND_S = 0.3
"""Duration of each stop if no node publishes detections."""
_LOOK_S = 3.0
"""Longest wait for detections at each stop."""
_STUCK_S = 5.0
_SLOWEST_RAD_S = 0.2
_THERE_RAD = 0.08
_ANSWER_S = 2.0


class RoomScan:
    """
    Implementation of the action `scan_room`.

    Parameters
    ----------
    node
        The node that owns the subscriptions and the clients.
    head, goals, parameters
        Its head, the goals that it runs, and its parameters.

    """

    def __init__(
        self,
        node: Node,
        head: Head,
        goals: SingleGoal,
        parameters: NodeParameters[GazeParameters],
    ) -> None:
        self._node, self._head, self._goals = node, head, goals
        self._parameters = parameters
        self._velocities = node.create_publisher(Twist, 'cmd_vel', COMMAND)
        self._find = node.create_client(FindObjects, 'find_objects')
        self._spin = ActionClient(node, Spin, 'spin')
        self._looks_s: list[float] = []
        self._end_s = math.inf

    async def work(self, goal: RunningGoal) -> None:
        """
        Scan the room: sweep the head, and turn the body between sweeps if the goal requests it.

        Parameters
        ----------
        goal
            A goal of `scan_room`. Its result is filled in with the coverage and the ids of the
            objects that were seen, even if the scan ends early.

        Raises
        ------
        GoalAborted
            The scan fails, exceeds its time allowance, or must end.
        GoalCanceled
            The client has canceled the goal.

        """
        begin_s = clock_s(self._node)
        allowed = goal.request.time_allowance
        allowed_s = allowed.sec + allowed.nanosec * 1e-9
        self._end_s = begin_s + allowed_s if allowed_s > 0.0 else math.inf
        detections = self._node.create_subscription(
            Detection3DArray, 'detections_3d', self._take, STATE, raw=True
        )
        try:
            with self._head.listening():
                await self._sweeps(goal)
        finally:
            self._node.destroy_subscription(detections)
            self._head.stop()
            goal.result.seen = await self._ids_since(begin_s)

    def _take(self, data: bytes) -> None:
        """Record the stamp of an image that the detector has processed."""
        self._looks_s.append(stamp_in(data))

    async def _sweeps(self, goal: RunningGoal) -> None:
        told = self._parameters.current
        await self._head.wait(goal)
        chain = self._head.chain
        field = await self._field_of_view(goal)
        tip = await self._head.known(goal, chain.tip_frame, told.camera_frame)
        base = await self._head.known(goal, told.odom_frame, chain.base_frame)
        up_rad, down_rad = told.scan_up_rad, told.scan_down_rad
        views = head_sweep(field, chain.lower_rad, chain.upper_rad, up_rad, down_rad)
        coverage = Coverage(up_rad, down_rad)
        coverage.want_only([(base @ chain.pose(view) @ tip)[:3, :3] for view in views], field)
        turns = []
        if goal.request.turn_body:
            coverage = Coverage(up_rad, min(down_rad, chain.upper_rad[1] + field.down_rad))
            turns = stances(field, chain.lower_rad[0], chain.upper_rad[0])
        for turn_rad in (0.0, *turns):
            if turn_rad:
                await self._move(goal, np.array([0.0, views[0][1]]))
                await self._turn(goal, turn_rad)
            for view in views:
                await self._move(goal, np.array(view))
                await self._look(goal, coverage, field)
        await self._move(goal, np.zeros(2))

    async def _field_of_view(self, goal: RunningGoal) -> FieldOfView:
        """Compute the field of view from `camera/camera_info`, waited for up to 5 s."""
        infos: list[CameraInfo] = []
        subscription = self._node.create_subscription(
            CameraInfo, 'camera/camera_info', infos.append, SENSOR
        )
        try:
            for _ in range(100):
                if infos:
                    break
                await goal.tick()
            else:
                raise GoalAborted('NO_CAMERA', "No camera publishes 'camera/camera_info'.")
        finally:
            self._node.destroy_subscription(subscription)
        info = infos[0]
        try:
            return FieldOfView.of(
                info.width, info.height, info.k[0], info.k[4], info.k[2], info.k[5]
            )
        except ValueError as error:
            raise GoalAborted('NO_CAMERA', str(error)) from error

    async def _move(self, goal: RunningGoal, angles_rad: Any) -> None:
        """Move the head to joint angles, and wait until it has arrived."""
        head = self._head
        duration_s = head.duration_s(angles_rad, self._parameters.current.max_velocity)
        head.send(angles_rad, duration_s)
        late_s = clock_s(self._node) + duration_s + _LATE_S
        while not head.has_arrived():
            if clock_s(self._node) > late_s:
                raise GoalAborted('HEAD_FAILED', 'The head did not reach its target.')
            await self._tick(goal)

    async def _tick(self, goal: RunningGoal) -> None:
        await goal.tick()
        self._check_time()

    def _check_time(self) -> None:
        if clock_s(self._node) > self._end_s:
            raise GoalAborted('TIMEOUT', 'The scan took longer than its time allowance.')

    async def _sleep(self, goal: RunningGoal, duration_s: float) -> None:
        end_s = clock_s(self._node) + duration_s
        while clock_s(self._node) < end_s <= clock_s(self._node) + duration_s + 1.0:
            await self._tick(goal)

    async def _look(self, goal: RunningGoal, coverage: Coverage, field: FieldOfView) -> None:
        """Hold still until enough images were processed; update and publish the coverage."""
        told = self._parameters.current
        await self._sleep(goal, _SETTLED_S)
        since_s = clock_s(self._node)
        self._looks_s.clear()
        is_blind = self._node.count_publishers('detections_3d') == 0
        until_s = since_s + (_BLIND_S if is_blind else _LOOK_S)
        while since_s <= clock_s(self._node) < until_s:
            if sum(each >= since_s for each in self._looks_s) >= told.looks_per_view:
                break
            await self._tick(goal)
        camera = self._head.pose(told.odom_frame, told.camera_frame)
        coverage.see(camera[:3, :3], field)
        goal.result.coverage = coverage.share
        goal.publish_feedback(ScanRoom.Feedback(coverage=coverage.share))

    async def _turn(self, goal: RunningGoal, turn_rad: float) -> None:
        """Turn the body in place."""
        choice = self._parameters.current.turn_with
        if choice == 'spin' or (choice == 'auto' and self._spin.server_is_ready()):
            await self._turn_with_spin(goal, turn_rad)
        else:
            await self._turn_with_velocities(goal, turn_rad)
        await self._sleep(goal, 2.0 * _SETTLED_S)

    async def _turn_with_spin(self, goal: RunningGoal, turn_rad: float) -> None:
        """Turn the body by the `spin` behaviour of Nav2, which checks for collisions."""
        limit_s = 4.0 * turn_rad / self._parameters.current.turn_rate_rad_s + _LATE_S
        request = Spin.Goal(target_yaw=turn_rad, time_allowance=Duration(sec=math.ceil(limit_s)))
        answer = await goal.delegate(self._spin, request, 'spin', 'BODY_FAILED', self._check_time)
        if answer.status != GoalStatus.STATUS_SUCCEEDED:
            reason = getattr(answer.result, 'error_msg', '')
            raise GoalAborted('BODY_FAILED', reason or "'spin' could not turn the body.")

    async def _turn_with_velocities(self, goal: RunningGoal, turn_rad: float) -> None:
        """Turn the body by cmd_vel until the odometry reports the requested turn."""
        told = self._parameters.current
        before = self._heading()
        turned, best, best_s = 0.0, 0.0, clock_s(self._node)
        try:
            while turned < turn_rad - _THERE_RAD:
                rate = min(told.turn_rate_rad_s, max(turn_rad - turned, _SLOWEST_RAD_S))
                velocity = Twist()
                velocity.angular.z = rate
                self._velocities.publish(velocity)
                await self._tick(goal)
                now, now_s = self._heading(), clock_s(self._node)
                turned += math.remainder(now - before, math.tau)
                before = now
                if turned > best + 0.05 or now_s < best_s:
                    best, best_s = max(turned, best), now_s
                if now_s - best_s > _STUCK_S:
                    raise GoalAborted(
                        'BODY_FAILED',
                        f'The body does not turn: {turned:.2f} of {turn_rad:.2f} rad. Something '
                        'may be in its way, or cmd_vel has another publisher.',
                    )
        finally:
            self._velocities.publish(Twist())

    def _heading(self) -> float:
        told = self._parameters.current
        pose = self._head.pose(told.odom_frame, self._head.chain.base_frame)
        return yaw_of(pose)

    async def _ids_since(self, begin_s: float) -> list[str]:
        """Query the ids of the objects seen since a time; empty without an object memory."""
        if not self._find.service_is_ready():
            return []
        answer = self._find.call_async(FindObjects.Request())
        for _ in range(round(_ANSWER_S * 20)):
            if answer.done():
                return [
                    each.id
                    for each in answer.result().objects
                    if each.last_seen.sec + each.last_seen.nanosec * 1e-9 >= begin_s
                ]
            await self._goals.tick()
        return []
