# SPDX-License-Identifier: Apache-2.0
"""The waypoint follower, which visits waypoints and runs a task at each of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
import importlib
import time
from typing import Any

from action_msgs.msg import GoalStatus
from geometry_msgs.msg import PoseStamped
from nav2_msgs.action import FollowGPSWaypoints, FollowWaypoints, NavigateToPose
from nav2_msgs.msg import MissedWaypoint
from nav2_util import ActionAborted, ActionServer, LifecycleNode, NavigationError, Rate
from nav2_util.parameters import parameter
from nav2_util.timing import steady_clock
from nav2_waypoint_follower.tasks import make_task
from rclpy.action import ActionClient

__all__ = ['WaypointFollower', 'WaypointFollowerParameters']

_UNKNOWN = FollowWaypoints.Result.UNKNOWN
_TASK_FAILED = FollowWaypoints.Result.TASK_EXECUTOR_FAILED
_SERVER_TIMEOUT_S = 2.0


@dataclass(frozen=True)
class WaypointFollowerParameters:
    """Parameters of the follower; names and defaults are those of Nav2."""

    stop_on_failure: bool = parameter(True, 'Whether a waypoint that is missed ends the goal.')
    loop_rate: int = parameter(20, 'How often to look, in Hz.', low=1, high=1000)
    global_frame_id: str = parameter('map', 'The frame of places on the earth.')
    waypoint_task_executor_plugin: str = parameter(
        'wait_at_waypoint', 'The task; its type is that of <name>.plugin.', read_only=True
    )


class _Missed(NavigationError):
    """A waypoint was not reached, or its task has failed."""

    def __init__(self, code: int, message: str) -> None:
        super().__init__(message)
        self.code = code


class WaypointFollower(LifecycleNode):
    """
    Waypoint follower, which offers `follow_waypoints` and `follow_gps_waypoints`.

    Parameters
    ----------
    node_name
        The node name, unless remapped.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    result_timeout_s = 900.0

    def __init__(self, node_name: str = 'waypoint_follower', **options: Any) -> None:
        super().__init__(node_name, **options)
        self._client: ActionClient | None = None
        self._handle: Any = None

    def configure(self) -> None:
        """Create the task, the client of the navigator, and the actions."""
        self.settings = self.parameters.declare(WaypointFollowerParameters)
        self._task = make_task(self, self.settings.current.waypoint_task_executor_plugin)
        self._client = ActionClient(self, NavigateToPose, 'navigate_to_pose')
        self._from_ll = self._find_converter()
        self._server = self.offer_action(
            FollowWaypoints, 'follow_waypoints', self._follow, check_goal=self._check
        )
        self._gps_server = self.offer_action(
            FollowGPSWaypoints,
            'follow_gps_waypoints',
            self._follow_gps,
            check_goal=self._check_gps,
        )

    def cleanup(self) -> None:
        """Destroy the client."""
        self._stop()
        if self._client is not None:
            self._client.destroy()
            self._client = None

    def _find_converter(self) -> Any:
        """Return the client of the service that converts GPS coordinates to the map frame."""
        try:
            kind = importlib.import_module('robot_localization.srv').FromLL
        except (ImportError, AttributeError):
            return None
        return self.create_client(kind, 'fromLL')

    def _check(self, goal: Any) -> str | None:
        return 'follow_gps_waypoints is running' if self._gps_server.is_running else None

    def _check_gps(self, goal: Any) -> str | None:
        if self._from_ll is None:
            return "GPS poses need the service fromLL of 'robot_localization'"
        if not self._from_ll.service_is_ready():
            return "there is no service fromLL; is robot_localization's navsat_transform running?"
        return 'follow_waypoints is running' if self._server.is_running else None

    async def _follow(self, goal: Any) -> None:
        await self._go_round(self._server, goal, list(goal.poses))

    async def _follow_gps(self, goal: Any) -> None:
        poses = []
        for place in goal.gps_poses:
            request = self._from_ll.srv_type.Request(ll_point=place.position)
            found = await self._from_ll.call_async(request)
            pose = PoseStamped()
            pose.header.frame_id = self.settings.current.global_frame_id
            pose.pose.position, pose.pose.orientation = found.map_point, place.orientation
            poses.append(pose)
        await self._go_round(self._gps_server, goal, poses)

    async def _go_round(self, server: ActionServer, goal: Any, poses: list[PoseStamped]) -> None:
        """Visit all waypoints, for the number of loops of a goal."""
        if not 0 <= goal.goal_index < len(poses):
            self._stop()
            raise ActionAborted(
                _UNKNOWN,
                'There are no waypoints. Give at least one.'
                if not poses
                else f'goal_index is {goal.goal_index}, but there are {len(poses)} waypoints.',
            )
        try:
            for loop in range(goal.number_of_loops + 1):
                for index in range(0 if loop else goal.goal_index, len(poses)):
                    await self._visit(server, poses[index], index)
        except Exception:
            # The navigation goal of a newer list preempts this one in the navigator.
            if not server.is_preempt_requested:
                self._stop()
            raise

    async def _visit(self, server: ActionServer, pose: PoseStamped, index: int) -> None:
        """Drive to a waypoint and run the task; record a failure, or abort the goal."""
        try:
            await self._drive(server, pose, index)
            try:
                await self._task.run(pose, index, server.check)
            except ActionAborted:
                raise
            except NavigationError as error:
                raise _Missed(_TASK_FAILED, f'Its task failed. {error}') from error
        except _Missed as missed:
            self._note(server, pose, index, missed)

    def _note(self, server: ActionServer, pose: PoseStamped, index: int, missed: _Missed) -> None:
        entry = MissedWaypoint(index=index, goal=pose, error_code=missed.code)
        if hasattr(entry, 'error_msg'):
            entry.error_msg = str(missed)
        server.result.missed_waypoints.append(entry)
        message = f'Waypoint {index} was missed. {missed}'
        if self.settings.current.stop_on_failure:
            code = missed.code if missed.code == _TASK_FAILED else _UNKNOWN
            raise ActionAborted(code, message)
        self.get_logger().warning(message)
        # A missed waypoint of Jazzy has no field for the reason; the goal continues and succeeds.
        server.result.error_msg = f'{server.result.error_msg} {message}'.lstrip()

    async def _drive(self, server: ActionServer, pose: PoseStamped, index: int) -> None:
        """Navigate to a pose."""
        client = self._client
        assert client is not None
        # On a steady clock: goals can be canceled even while a simulation is paused.
        with Rate(self, self.settings.current.loop_rate, clock=steady_clock()) as rate:
            await self._until(server, rate, index, client.server_is_ready)
            sending = client.send_goal_async(NavigateToPose.Goal(pose=pose))
            sending.add_done_callback(self._keep)
            await self._until(server, rate, index, sending.done)
            handle = sending.result()
            if not handle.accepted:
                raise _Missed(_UNKNOWN, 'The navigator rejected the goal. Is it active?')
            ending = handle.get_result_async()
            await self._until(server, rate, index, ending.done, None)
        answer, self._handle = ending.result(), None
        if answer.status == GoalStatus.STATUS_CANCELED:
            raise _Missed(_UNKNOWN, 'The navigation to it was canceled by another client.')
        if answer.status != GoalStatus.STATUS_SUCCEEDED:
            reason = answer.result.error_msg or 'The navigator gave no reason.'
            raise _Missed(answer.result.error_code or _UNKNOWN, reason)

    def _keep(self, sending: Any) -> None:
        """Store the handle of an accepted goal, to cancel it."""
        handle = sending.result()
        if handle is not None and handle.accepted:
            self._handle = handle

    async def _until(
        self,
        server: ActionServer,
        rate: Rate,
        index: int,
        is_done: Callable[[], bool],
        timeout_s: float | None = _SERVER_TIMEOUT_S,
    ) -> None:
        """Wait for a future, publish feedback, and stop when the goal ends."""
        end_s = None if timeout_s is None else time.monotonic() + timeout_s
        kind = FollowGPSWaypoints if server is self._gps_server else FollowWaypoints
        while not is_done():
            if end_s is not None and time.monotonic() > end_s:
                raise _Missed(_UNKNOWN, "The navigator does not offer 'navigate_to_pose'.")
            server.check()
            server.publish_feedback(kind.Feedback(current_waypoint=index))
            await rate.tick()
        server.check()

    def _stop(self) -> None:
        """Cancel the goal of the navigator."""
        if self._handle is not None:
            self._handle.cancel_goal_async()
            self._handle = None
