# SPDX-License-Identifier: Apache-2.0
"""A page with panels of what a system says, browsers that look at them, and a robot."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
import json
import os
import threading
import time
from typing import Any
from unittest import mock

from domain_coordinator import domain_id
import rclpy
from rclpy.action import ActionClient, ActionServer
from rclpy.context import Context as RosContext
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from robot_console.live_panel import LivePanel
from robot_console.panels.command import Command
from robot_console.panels.diagnostics import Diagnostics
from robot_console.panels.gestures import Gestures
from robot_console.panels.log import Log
from robot_console.panels.objects import Objects
from robot_console.panels.parameters import Parameters
from robot_console.panels.robot import Robot
from robot_console.panels.services import Services
from robot_console.panels.sliders import Sliders
from robot_console.panels.topics import Topics
from rviz_common.context import Context
from rviz_common.inputs import WorkQueue
from rviz_common.page import NO_TOKEN, Page, PageSettings
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

__all__ = ['PANELS', 'Browser', 'LiveWorld', 'live_world']

PANELS = {'log': Log, 'diagnostics': Diagnostics, 'topics': Topics}
PANELS |= {'command': Command, 'objects': Objects, 'parameters': Parameters, 'robot': Robot}
PANELS |= {'gestures': Gestures, 'services': Services, 'sliders': Sliders}


class LiveWorld:
    """A page with a panel, and a robot, in a domain of their own."""

    def __init__(self, domain: int, page: Page) -> None:
        """Start the robot."""
        self.page = page
        self.ros = RosContext()
        rclpy.init(context=self.ros, domain_id=domain)
        self.node = Node('console', context=self.ros)
        self.robot = Node('robot', namespace='robot1', context=self.ros)
        self.executor = SingleThreadedExecutor(context=self.ros)
        for node in (self.node, self.robot):
            self.executor.add_node(node)
        self.context = Context(self.node, page, None, WorkQueue())  # type: ignore[arg-type]
        self.panels: list[LivePanel] = []

    def visit(self, name: str, **given: Any) -> Browser:
        """Start a panel, and look at it."""
        self.start(name, **given)
        return self.look(name, given.get('Namespace', ''))

    def start(self, name: str, **given: Any) -> None:
        """Start a panel."""
        panel = PANELS[name](self.context, given)
        panel.start()
        self.panels.append(panel)

    def look(self, name: str, namespace: str = '') -> Browser:
        """Look at a panel."""
        path = f'/{name}/{namespace}' if namespace else f'/{name}'
        return Browser(self, f'ws://127.0.0.1:{self.page.port}{path}')

    def wait_until(self, predicate: Callable[[], bool], what: str, told: Any = None) -> None:
        """Let time pass until something holds."""
        end_s = time.monotonic() + 100.0
        while not predicate():
            assert time.monotonic() < end_s, f'{what}; told: {str(told)[-2000:]}'
            self.executor.spin_once(timeout_sec=0.02)
            self.context.queue.run()
            for panel in self.panels:
                panel.update()

    def close(self) -> None:
        """End all of it, with the nodes of tests: the next world may be in this domain."""
        nodes = self.executor.get_nodes()
        for panel in self.panels:
            panel.close()
        self.page.close()
        self.executor.shutdown()
        for node in nodes:
            for each in [*node.waitables]:  # an action server keeps its node, and that the domain
                if isinstance(each, (ActionClient, ActionServer)):
                    each.destroy()
            node.destroy_node()
        self.ros.try_shutdown()


class Browser:
    """A browser that looks at a panel, and notes down what it is told."""

    def __init__(self, world: LiveWorld, url: str) -> None:
        """Connect."""
        self.world = world
        self.told: list[dict[str, Any]] = []
        self.connection = connect(url)
        self._reading = threading.Thread(target=self._read, daemon=True)
        self._reading.start()

    def _read(self) -> None:
        with suppress(ConnectionClosed):
            for text in self.connection:
                self.told.append(json.loads(text))

    def ask(self, do: str, **values: Any) -> None:
        """Ask for something."""
        self.connection.send(json.dumps({'do': do, **values}))

    def wait_for(self, key: str, predicate: Callable[[Any], bool] = bool) -> dict[str, Any]:
        """Wait until something is told that has a key with such a value, and return all of it."""

        def found() -> list[dict[str, Any]]:
            return [each for each in self.told if key in each and predicate(each[key])]

        self.world.wait_until(lambda: bool(found()), f"no such '{key}'", self.told)
        return found()[-1]


@contextmanager
def live_world() -> Iterator[LiveWorld]:
    """Give a page and a robot, in a domain of their own."""
    quiet = {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'}
    with domain_id() as domain, mock.patch.dict(os.environ, quiet):
        world = LiveWorld(domain, Page('test', PageSettings(token=NO_TOKEN)))
        try:
            yield world
        finally:
            world.close()
