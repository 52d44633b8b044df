# SPDX-License-Identifier: Apache-2.0
"""Sliders of a joint_state_publisher_gui that runs in another process: their ranges and values."""

from __future__ import annotations

from collections.abc import Iterable
import time
from typing import Any, TYPE_CHECKING

from joint_state_publisher.merged_joints import MergedJoints
from joint_state_publisher.settings import settings_of
from joint_state_publisher_gui.board import Board
from rclpy.qos import QoSProfile, ReliabilityPolicy
from robot_console.panels.parameters import RemoteParameters
from robot_console.service_calls import ServiceCalls
from rviz_common.pace import Pace
from rviz_common.polled_topic import PolledTopic
from rviz_default_plugins.robot.description import DescriptionTopic
from sensor_msgs.msg import JointState
from urdf import parse_urdf

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['POSITIONS', 'RemoteSliders']

POSITIONS = 'slider_positions'
"""The topic below the name of the node on which it takes positions."""
NEWEST = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
LOOK_S = 1.0
HOLD_S = 1.0
"""How long a joint state is awaited that has the position which was sent."""
SAME = 1e-9
ASKING = 'Asking the node for the ranges of its sliders ...'


class RemoteSliders:
    """
    The sliders of a joint_state_publisher_gui, as its parameters and the robot description say.

    They show the joint states that the node publishes. A joint that was moved keeps its new
    position until the node publishes that, so that older joint states do not move it back.

    Parameters
    ----------
    node
        The node that asks, listens and publishes.
    name, joint_states, description
        The full names of the other node, and of the topics.

    Attributes
    ----------
    board
        The sliders; None while they are unknown.
    problem
        Why they are unknown, as a sentence; '' if they are known.

    """

    def __init__(self, node: Node, name: str, joint_states: str, description: str) -> None:
        self._node = node
        self._topic, self._description_topic = f'{name}/{POSITIONS}', description
        self.board: Board | None = None
        self.problem = ASKING
        self._joints: MergedJoints | None = None
        self._calls = ServiceCalls(node)
        self._parameters = RemoteParameters(self._calls, name)
        self._is_asked = False
        self._values: dict[str, Any] | None = None
        self._text = ''
        self._sent: dict[str, float] = {}
        self._look = Pace(LOOK_S)
        self._states = PolledTopic(node, JointState, joint_states, NEWEST)
        self._states.rest()
        self._description = DescriptionTopic(node, description, self._describe)
        self._publisher = node.create_publisher(JointState, self._topic, QoSProfile(depth=10))

    def update(self) -> None:
        """Follow the node and its joint states; call it often while somebody watches."""
        self._states.resume()
        self._calls.update()
        if self._look.is_due():
            self._look_for_node()
        self._follow()

    def rest(self) -> None:
        """Follow the joint states no longer, and ask the node anew at the next `update`."""
        self._states.rest()
        self._is_asked = False
        self._look.hurry()

    def send(self, names: Iterable[str]) -> None:
        """
        Publish the positions of sliders that were moved.

        Parameters
        ----------
        names
            The joints, all of which have a slider.

        """
        if self.board is None:
            return
        positions = {name: self.board.sliders[name].position for name in names}
        self._sent.update(dict.fromkeys(positions, time.monotonic() + HOLD_S))
        message = JointState(name=list(positions), position=list(positions.values()))
        message.header.stamp = self._node.get_clock().now().to_msg()
        self._publisher.publish(message)

    def close(self) -> None:
        """Destroy the publisher, the subscriptions and the clients."""
        self._calls.close()
        self._states.close()
        self._description.close()
        self._node.destroy_publisher(self._publisher)

    def _look_for_node(self) -> None:
        """Ask a node that has appeared for its parameters, or note that there is none."""
        if not self._node.count_subscribers(self._topic):
            self._is_asked, self._values = False, None
            self._clear(
                f"There is no joint_state_publisher_gui: no node subscribes to '{self._topic}'. "
                'Start it: ros2 run joint_state_publisher_gui joint_state_publisher_gui'
            )
        elif not self._is_asked:
            self._is_asked = True
            self._parameters.load(self._take_parameters)

    def _take_parameters(self, reason: str) -> None:
        if reason:
            self._is_asked = False
            self._clear(reason)
            return
        values = self._parameters.plain_values()
        if values != self._values or self.board is None:
            self._values = values
            self._build()

    def _describe(self, text: str, source: str) -> None:
        if text != self._text:
            self._text = text
            self._build()

    def _build(self) -> None:
        """Make the sliders, once the parameters and the robot description are known."""
        if self._values is None:
            return
        text = self._values.get('robot_description') or self._text
        if not text:
            self._clear(f"There is no robot description on '{self._description_topic}' yet.")
            return
        try:
            model = parse_urdf(text, 'robot_description')
            self._joints = MergedJoints(model, settings_of(self._values))
        except ValueError as error:
            self._clear(str(error))
            return
        self.board, self.problem = Board(model, self._joints), ''
        self._sent.clear()

    def _clear(self, problem: str) -> None:
        """Have no sliders, for a reason."""
        self.board, self._joints, self.problem = None, None, problem

    def _follow(self) -> None:
        """Move the sliders to the newest joint states."""
        for message, _ in self._states.take():
            for name, position in zip(message.name, message.position):
                if self._joints is not None and name in self._joints.free:
                    self._take(self._joints, name, position)

    def _take(self, joints: MergedJoints, name: str, position: float) -> None:
        joint = joints.free[name]
        if name in self._sent:
            is_awaited = time.monotonic() < self._sent[name]
            if is_awaited and abs(position - (joint.position or 0.0)) > SAME:
                return
            del self._sent[name]
        joint.position = position
