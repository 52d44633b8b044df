# SPDX-License-Identifier: Apache-2.0
"""A joint_state_publisher_gui, as its panel sees it."""

from __future__ import annotations

from typing import Any

from live_world import LiveWorld
from rclpy.node import Node
from robot_console.robot_link import LATCHED
from sensor_msgs.msg import JointState
from std_msgs.msg import String

__all__ = ['URDF', 'SliderNode']

URDF = """<robot name="arm"><link name="a"/><link name="b"/><link name="c"/>
<joint name="left_elbow" type="revolute"><parent link="a"/><child link="b"/>
<limit lower="-1" upper="2" velocity="9" effort="1"/></joint>
<joint name="lift" type="prismatic"><parent link="a"/><child link="c"/>
<limit lower="0" upper="0.5" velocity="9" effort="1"/></joint></robot>"""


class SliderNode:
    """A node that takes positions, and publishes joint states when the test says so."""

    def __init__(self, world: LiveWorld, urdf: str = URDF, **zeros: float) -> None:
        """Publish the robot description at once."""
        self.node = Node('joint_state_publisher', context=world.ros)
        world.executor.add_node(self.node)
        for name, value in zeros.items():
            self.node.declare_parameter(f'zeros.{name}', value)
        self.sent: list[dict[str, float]] = []
        self.node.create_subscription(JointState, '~/slider_positions', self._take, 10)
        self._states = self.node.create_publisher(JointState, 'joint_states', 10)
        self._described = self.node.create_publisher(String, 'robot_description', LATCHED)
        self.describe(urdf)

    def describe(self, urdf: str) -> None:
        """Publish a robot description."""
        self._described.publish(String(data=urdf))

    def say(self, **positions: float) -> None:
        """Publish a joint state."""
        names, values = list(positions), list(positions.values())
        self._states.publish(JointState(name=names, position=values))

    def say_until(self, world: LiveWorld, predicate: Any, **positions: float) -> None:
        """Publish a joint state again and again, as the real node does, until something holds."""

        def holds() -> bool:
            self.say(**positions)
            return bool(predicate())

        world.wait_until(holds, f'no effect of {positions}')

    def end(self, world: LiveWorld) -> None:
        """Destroy the node."""
        world.executor.remove_node(self.node)
        self.node.destroy_node()

    def _take(self, message: JointState) -> None:
        self.sent.append(dict(zip(message.name, message.position)))
