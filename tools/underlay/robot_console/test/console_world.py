# SPDX-License-Identifier: Apache-2.0
"""A page with the panels of safety and driving, and a robot on the other side."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import json
import os
import time
from typing import Any
from unittest import mock

from domain_coordinator import domain_id
from geometry_msgs.msg import Twist
import rclpy
from rclpy.context import Context as RosContext
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from robot_console.panels.drive import Drive
from robot_console.panels.safety import Safety
from robot_console.robot_link import LATCHED
from rviz_common.context import Context
from rviz_common.inputs import WorkQueue
from rviz_common.page import NO_TOKEN, Page, PageSettings
from rviz_common.panel import Panel
from std_msgs.msg import Bool
from websockets.sync.client import ClientConnection, connect

__all__ = ['Client', 'World', 'world_of']

MANY = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)


class World:
    """A page with both panels, and a robot, in a domain of their own."""

    def __init__(self, domain: int, page: Page, namespace: str) -> None:
        """Start the panels, and the robot's ears."""
        self.page, self.namespace = page, namespace
        self.ros = RosContext()
        rclpy.init(context=self.ros, domain_id=domain)
        self.node = Node('console', context=self.ros)
        self.robot = Node('robot', namespace=namespace, context=self.ros)
        self.heard: dict[str, list[Any]] = {'stop': [], 'beat': [], 'twist': []}
        self._hear(Bool, 'emergency_stop', LATCHED, 'stop')
        self._hear(Bool, 'console_heartbeat', MANY, 'beat')
        self._hear(Twist, 'cmd_vel', 100, 'twist')
        self.executor = SingleThreadedExecutor(context=self.ros)
        for node in (self.node, self.robot):
            self.executor.add_node(node)
        self.context = Context(self.node, page, None, WorkQueue())  # type: ignore[arg-type]
        given = {'Namespace': namespace}
        self.panels: list[Panel] = [Safety(self.context, given), Drive(self.context, given)]
        for panel in self.panels:
            panel.start()

    def _hear(self, kind: type, topic: str, qos: Any, key: str) -> None:
        self.robot.create_subscription(kind, topic, self.heard[key].append, qos)

    @property
    def stop_topic(self) -> str:
        """Return where a stop of the robot is published."""
        return str(self.robot.resolve_topic_name('emergency_stop'))

    def url(self, name: str) -> str:
        """Return the address of a small page."""
        below = f'/{self.namespace}' if self.namespace else ''
        return f'127.0.0.1:{self.page.port}/{name}{below}'

    def visit(self, name: str, me: str = 'ann') -> Client:
        """Connect to a small page."""
        return Client(self, f'ws://{self.url(name)}?me={me}')

    def wait_until(self, predicate: Callable[[], bool], what: str) -> None:
        """Let time pass until something holds."""
        end_s = time.monotonic() + 100.0
        while not predicate():
            assert time.monotonic() < end_s, f'{what}; heard: {self.heard}'
            self.executor.spin_once(timeout_sec=0.02)
            self.context.queue.run()
            for panel in self.panels:
                panel.update()

    def twists(self) -> list[tuple[float, float]]:
        """Return forward and turning speeds of what the robot heard."""
        return [(each.linear.x, each.angular.z) for each in self.heard['twist']]

    def stops(self) -> list[bool]:
        """Return what the robot heard of the emergency stop."""
        return [each.data for each in self.heard['stop']]

    def beats(self) -> list[bool]:
        """Return the heartbeats that the robot heard."""
        return [each.data for each in self.heard['beat']]

    def close(self) -> None:
        """End all of it."""
        for panel in self.panels:
            panel.close()
        self.page.close()
        self.executor.shutdown()
        for node in (self.node, self.robot):
            node.destroy_node()
        self.ros.try_shutdown()


class Client:
    """A small page that a browser shows."""

    def __init__(self, world: World, url: str) -> None:
        """Connect."""
        self.world = world
        self.connection: ClientConnection = connect(url)

    def say(self, message: Any) -> dict[str, Any]:
        """Send something, and return the answer."""
        self.connection.send(json.dumps(message))
        return json.loads(self.connection.recv(timeout=100))

    def close(self) -> None:
        """Disconnect in order."""
        self.connection.close()


@contextmanager
def world_of(namespace: str) -> Iterator[World]:
    """Give a page, panels and a robot, which find each other, in a domain of their own."""
    quiet = {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'}
    with domain_id() as domain, mock.patch.dict(os.environ, quiet):
        world = World(domain, Page('test', PageSettings(token=NO_TOKEN)), namespace)
        try:
            names = ('emergency_stop', 'console_heartbeat', 'cmd_vel')
            world.wait_until(lambda: all(_is_heard(world, name) for name in names), 'no discovery')
            yield world
        finally:
            world.close()


def _is_heard(world: World, topic: str) -> bool:
    full = world.robot.resolve_topic_name(topic)
    return world.node.count_subscribers(full) > 0 and world.robot.count_publishers(full) > 0
