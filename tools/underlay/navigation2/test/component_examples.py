# SPDX-License-Identifier: Apache-2.0
"""Components that tests load into containers, and the registration of them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from nav2_msgs.action import Wait
from nav2_util import LifecycleNode, NavigationError, sleep
from rclpy.node import Node
from std_msgs.msg import String

__all__ = ['COMPONENTS', 'PACKAGE', 'register']

PACKAGE = 'example_components'
COMPONENTS = {
    'Talker': 'component_examples:Talker',
    'Worker': 'component_examples:Worker',
    'Raises': 'component_examples:Raises',
    'Refuses': 'component_examples:Refuses',
    'NoModule': 'no_such_module_of_components:Talker',
    'NoClass': 'component_examples:NoSuchClass',
    'OfCpp': 'lib/libtalker.so',
}


def register(prefix: Path) -> None:
    """Write a package with these components below a prefix."""
    index = prefix / 'share' / 'ament_index' / 'resource_index'
    for kind in ('packages', 'rclcpp_components'):
        (index / kind).mkdir(parents=True)
    (index / 'packages' / PACKAGE).touch()
    (index / 'packages' / 'empty_components').touch()
    lines = [f'{PACKAGE}::{name};{place}\n' for name, place in COMPONENTS.items()]
    (index / 'rclcpp_components' / PACKAGE).write_text(''.join(lines), encoding='utf-8')


class Talker(Node):
    """Publishes on a topic; has a parameter."""

    def __init__(self, node_name: str = 'talker', **options: Any) -> None:
        super().__init__(node_name, **options)
        self.declare_parameter('number', 1)
        self.publisher = self.create_publisher(String, 'chatter', 1)


class Worker(LifecycleNode):
    """Waits as long as a goal says."""

    def __init__(self, node_name: str = 'worker', **options: Any) -> None:
        super().__init__(node_name, **options)

    def configure(self) -> None:
        """Offer the action and make a timer."""
        self.create_timer(0.01, lambda: None)
        self.server = self.offer_action(Wait, 'wait', self.work)

    async def work(self, goal: Any) -> None:
        """Wait, and tell the time that is left."""
        for _ in range(100 * goal.time.sec):
            self.server.check()
            self.server.publish_feedback(Wait.Feedback())
            await sleep(self, 0.01)


class Raises(Node):
    """Cannot be made, after rclpy has made its node."""

    def __init__(self, node_name: str = 'raises', **options: Any) -> None:
        super().__init__(node_name, **options)
        raise RuntimeError('no such luck')


class Refuses(Node):
    """Cannot be made with these parameters, which it says in a sentence."""

    def __init__(self, node_name: str = 'refuses', **options: Any) -> None:
        super().__init__(node_name, **options)
        raise NavigationError('There is no map.')
