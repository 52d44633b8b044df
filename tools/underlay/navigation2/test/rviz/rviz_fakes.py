# SPDX-License-Identifier: Apache-2.0
"""Servers of navigation that do as a test says, and a page that looks at them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import gc
import json
import os
import threading
import time
from typing import Any
from unittest import mock

from domain_coordinator import domain_id
from nav2_msgs.action import FollowWaypoints, NavigateThroughPoses, NavigateToPose
from nav2_msgs.srv import ManageLifecycleNodes
from nav2_rviz_plugins.session import close_sessions
import rclpy
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.context import Context as RosContext
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from rviz_common.config import Configuration
from rviz_common.page import NO_TOKEN, Page, PageSettings
from rviz_common.visualizer import Visualizer
from std_srvs.srv import Trigger
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

__all__ = ['FakeServer', 'NavigationWorld', 'navigation_world']

KINDS = {
    'navigate_to_pose': NavigateToPose,
    'navigate_through_poses': NavigateThroughPoses,
    'follow_waypoints': FollowWaypoints,
}
TIMEOUT_S = 60.0
FILE = """
Panels:
  - Class: nav2_rviz_plugins/Navigation 2
    Name: Navigation 2
Visualization Manager:
  Displays: []
  Global Options:
    Fixed Frame: map
"""


class FakeServer:
    """A server of an action; `goals` are those that it was sent."""

    def __init__(self, node: Node, name: str) -> None:
        """Offer the action."""
        self.kind = KINDS[name]
        self.goals: list[Any] = []
        self.accepts = True
        self._ends: list[Future] = []
        self.server = ActionServer(
            node,
            self.kind,
            name,
            self._work,
            goal_callback=lambda _: GoalResponse.ACCEPT if self.accepts else GoalResponse.REJECT,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
        )

    async def _work(self, handle: Any) -> Any:
        self.goals.append(handle)
        self._ends.append(Future())
        return await self._ends[-1]

    def feed(self, **values: Any) -> None:
        """Publish feedback on the newest goal; do so again until it is heard."""
        feedback = self.kind.Feedback()
        for name, value in values.items():
            if name.endswith(('_time', '_remaining')) and isinstance(value, int):
                getattr(feedback, name).sec = value
            else:
                setattr(feedback, name, value)
        self.goals[-1].publish_feedback(feedback)

    def close(self) -> None:
        """Offer the action no longer."""
        for future in self._ends:
            future.set_result(self.kind.Result())
        self.goals.clear()
        self.server.destroy()

    def end(self, how: str, code: int = 0, reason: str = '', **values: Any) -> None:
        """End the newest goal: succeed, abort or canceled."""
        getattr(self.goals[-1], how)()
        result = self.kind.Result(error_code=code, **values)
        if hasattr(result, 'error_msg'):
            result.error_msg = reason
        self._ends[-1].set_result(result)


class NavigationWorld:
    """A page with the panel of navigation, and servers, in a domain of their own."""

    def __init__(self, domain: int, page: Page, text: str) -> None:
        """Start the page."""
        self.page = page
        self.ros = RosContext()
        rclpy.init(context=self.ros, domain_id=domain)
        self.node = Node('rviz2', context=self.ros)
        self.robot = Node('robot', context=self.ros)
        self.executor = SingleThreadedExecutor(context=self.ros)
        for node in (self.node, self.robot):
            self.executor.add_node(node)
        self.visualizer = Visualizer(self.node, page, Configuration.parse(text, 'test.rviz'))
        self.servers: dict[str, FakeServer] = {}
        self.commands: list[tuple[str, int]] = []
        self.is_active = True

    def serve(self, *names: str) -> None:
        """Start servers of actions, and wait until the page may find them."""
        for name in names:
            self.servers[name] = FakeServer(self.robot, name)

    def manage(self, *parts: str) -> None:
        """Start lifecycle managers of such parts: localization, navigation."""

        def answer(_: Any, response: Any) -> Any:
            response.success = self.is_active
            return response

        def obey(part: str, request: Any, response: Any) -> Any:
            self.commands.append((part, request.command))
            self.is_active = request.command in (0, 2)
            response.success = True
            return response

        for part in parts:
            name = f'lifecycle_manager_{part}'
            self.robot.create_service(Trigger, f'{name}/is_active', answer)
            self.robot.create_service(
                ManageLifecycleNodes,
                f'{name}/manage_nodes',
                lambda request, response, part=part: obey(part, request, response),
            )

    def visit(self) -> Visitor:
        """Look at the panel as a browser does."""
        return Visitor(self, f'ws://127.0.0.1:{self.page.port}/navigation')

    def wait_until(self, predicate: Callable[[], Any], what: str, seen: Any = None) -> None:
        """Let time pass until something holds."""
        end_s = time.monotonic() + TIMEOUT_S
        while not predicate():
            assert time.monotonic() < end_s, f'{what}; seen: {seen}'
            self.executor.spin_once(timeout_sec=0.02)

    def close(self) -> None:
        """End all of it; what is left of a server would be heard by the next test."""
        self.visualizer.close()
        close_sessions(self.node)
        for server in self.servers.values():
            server.close()
        for _ in range(20):
            self.executor.spin_once(timeout_sec=0.0)
        self.executor.shutdown()
        for node in (self.node, self.robot):
            node.destroy_node()
        self.ros.try_shutdown()
        self.servers.clear()
        gc.collect()


class Visitor:
    """A browser that looks at the panel, and knows what it was told last."""

    def __init__(self, world: NavigationWorld, url: str) -> None:
        """Connect."""
        self.world = world
        self.state: dict[str, Any] = {}
        self.refusals: list[str] = []
        self._connection = connect(url)
        threading.Thread(target=self._read, daemon=True).start()
        world.wait_until(lambda: self.state, 'nothing is told')

    def _read(self) -> None:
        try:
            for text in self._connection:
                news = json.loads(text)
                if 'refusal' in news:
                    self.refusals.append(news['refusal'])
                else:
                    self.state = news
        except ConnectionClosed:
            pass

    def ask(self, do: str, **values: Any) -> None:
        """Ask for something."""
        self._connection.send(json.dumps({'do': do, **values}))

    def wait_for(self, what: str, predicate: Callable[[dict[str, Any]], Any]) -> dict[str, Any]:
        """Wait until what is told is so, and return it."""
        self.world.wait_until(lambda: predicate(self.state), what, self.state)
        return self.state

    def wait_for_feedback(self, server: FakeServer, **values: Any) -> dict[str, Any]:
        """Have feedback published until it is told, and return the goal."""

        def is_told(state: dict[str, Any]) -> bool:
            server.feed(**values)
            name = next(iter(values))
            return bool(state['goal']['numbers'].get(name) == values[name])

        goal: dict[str, Any] = self.wait_for('no feedback', is_told)['goal']
        return goal

    def wait_for_phase(self, phase: str) -> dict[str, Any]:
        """Wait until the goal is in a phase whose reason is known, and return the goal."""
        self.wait_for(
            phase,
            lambda state: (
                state['goal']
                and state['goal']['phase'] == phase
                and (state['goal']['text'] or not state['goal']['over'])
            ),
        )
        goal: dict[str, Any] = self.state['goal']
        return goal


@contextmanager
def navigation_world(text: str = FILE) -> Iterator[NavigationWorld]:
    """Give a page in a domain of its own."""
    quiet = {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'}
    settings = PageSettings(token=NO_TOKEN)
    with domain_id() as domain, mock.patch.dict(os.environ, quiet), Page('test', settings) as page:
        world = NavigationWorld(domain, page, text)
        try:
            yield world
        finally:
            world.close()
