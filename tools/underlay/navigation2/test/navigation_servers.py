# SPDX-License-Identifier: Apache-2.0
"""Servers that a navigator needs, which do what a test has written for them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from geometry_msgs.msg import PoseStamped, TransformStamped
from nav2_msgs import action, srv
from nav2_util import ActionAborted, ActionServer, Pose2D, sleep
from nav2_util.geometry import make_path, make_pose_stamped
from rclpy.action import ActionClient
from rclpy.node import Node
from tf2_ros import StaticTransformBroadcaster

__all__ = ['Client', 'Servers', 'pose']

Script = Callable[..., Any]
_ACTIONS = {
    'compute_path_to_pose': action.ComputePathToPose,
    'compute_path_through_poses': action.ComputePathThroughPoses,
    'follow_path': action.FollowPath,
    'smooth_path': action.SmoothPath,
    'spin': action.Spin,
    'backup': action.BackUp,
    'wait': action.Wait,
    'drive_on_heading': action.DriveOnHeading,
    'assisted_teleop': action.AssistedTeleop,
}


def pose(x: float, y: float = 0.0, yaw: float = 0.0, frame: str = 'map') -> PoseStamped:
    """Return a pose without a time."""
    return make_pose_stamped(Pose2D(x, y, yaw), frame, PoseStamped().header.stamp)


def _lasts(todo: Any, waited_s: float) -> bool:
    """Check whether an action that has an entry of a script goes on."""
    if callable(todo):
        return not todo()
    return todo == 'hang' or (isinstance(todo, float) and waited_s < todo)


class Servers:
    """
    All servers of navigation in a node.

    `scripts` has, by the name of an action, a list with what to do with its next goals: None for
    success, a tuple (code, message) for a failure, a number for a success after so many s, a
    function for a success once it returns true, 'hang' to go on until it is canceled. The last
    entry holds for all further goals.
    """

    def __init__(self, node: Node, missing: tuple[str, ...] = ()) -> None:
        self.node = node
        self.scripts: dict[str, list[Any]] = {}
        self.goals: dict[str, list[Any]] = {name: [] for name in _ACTIONS}
        self.calls: list[str] = []
        self.canceled: list[str] = []
        self.path_is_valid = True
        self.servers = {
            name: ActionServer(node, kind, name, self._worker(name), takes_over=True)
            for name, kind in _ACTIONS.items()
            if name not in missing
        }
        for server in self.servers.values():
            server.activate()
        for each in ('global', 'local'):
            node.create_service(
                srv.ClearEntireCostmap,
                f'{each}_costmap/clear_entirely_{each}_costmap',
                self._note(f'clear {each}'),
            )
        node.create_service(srv.IsPathValid, 'is_path_valid', self._is_valid)
        self._broadcaster = StaticTransformBroadcaster(node)
        self.move(0.0, 0.0)

    def move(self, x: float, y: float) -> None:
        """Put the robot somewhere."""
        moved = TransformStamped()
        moved.header.frame_id, moved.child_frame_id = 'map', 'base_link'
        moved.header.stamp = self.node.get_clock().now().to_msg()
        moved.transform.translation.x, moved.transform.translation.y = x, y
        moved.transform.rotation.w = 1.0
        self._broadcaster.sendTransform(moved)

    def close(self) -> None:
        """Destroy the actions."""
        for server in self.servers.values():
            server.destroy()

    def _note(self, what: str) -> Script:
        def answer(request: Any, response: Any) -> Any:
            self.calls.append(what)
            return response

        return answer

    def _is_valid(self, request: Any, response: Any) -> Any:
        self.calls.append('is valid')
        response.is_valid = self.path_is_valid
        return response

    def _worker(self, name: str) -> Script:
        async def work(goal: Any) -> None:
            server = self.servers[name]
            while True:
                self._begin(name, goal)
                script = self.scripts.setdefault(name, [None])
                todo = script.pop(0) if len(script) > 1 else script[0]
                if isinstance(todo, tuple):
                    raise ActionAborted(*todo)
                waited = 0.0
                try:
                    while _lasts(todo, waited):
                        server.check()
                        if server.is_preempt_requested:
                            break
                        await sleep(self.node, 0.01)
                        waited += 0.01
                except Exception:
                    self.canceled.append(name)
                    raise
                if not server.is_preempt_requested:
                    break
                goal = server.accept_pending()
            self._fill(name, goal, server.result)

        return work

    def _begin(self, name: str, goal: Any) -> None:
        self.calls.append(name)
        self.goals[name].append(goal)

    def _fill(self, name: str, goal: Any, result: Any) -> None:
        if name.startswith('compute_path'):
            goals = goal.goals if name.endswith('poses') else [goal.goal]
            points = [Pose2D(0.0, 0.0, 0.0)]
            points += [Pose2D(p.pose.position.x, p.pose.position.y, 0.0) for p in goals]
            result.path = make_path(points, 'map', self.node.get_clock().now().to_msg())


class Client:
    """Sends goals of an action, and keeps what comes back."""

    def __init__(self, ros: Any, node: Node, kind: Any, name: str) -> None:
        self.ros, self._client, self._kind = ros, ActionClient(node, kind, name), kind
        self.feedback: list[Any] = []
        ros.wait_until(self._client.server_is_ready, what=f"the action '{name}'")

    def send(self, **fields: Any) -> Any:
        """Send a goal; return its handle."""
        future = self._client.send_goal_async(
            self._kind.Goal(**fields), lambda each: self.feedback.append(each.feedback)
        )
        self.ros.wait_until(future.done, what='an answer to the goal')
        handle = future.result()
        handle.end = handle.get_result_async() if handle.accepted else None
        return handle

    def wait(self, handle: Any, timeout_s: float = 20.0) -> Any:
        """Wait for the end of a goal; return status and result."""
        self.ros.wait_until(handle.end.done, timeout_s, 'the end of the goal')
        answer = handle.end.result()
        return answer.status, answer.result

    def close(self) -> None:
        """Destroy the client."""
        self._client.destroy()
