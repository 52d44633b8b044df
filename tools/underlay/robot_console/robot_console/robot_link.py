# SPDX-License-Identifier: Apache-2.0
"""What all pages of a robot share: emergency stop, control, user names and heartbeat."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
import time
from typing import Any
from weakref import WeakKeyDictionary

from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from robot_console.control import Control, People
from robot_console.namespaces import below
from rviz_common.context import Context
from rviz_common.page import Page
from std_msgs.msg import Bool, String

__all__ = [
    'COMMAND',
    'LATCHED',
    'EmergencyStop',
    'RobotLink',
    'link_of',
    'node_names',
]

LATCHED = QoSProfile(
    depth=1,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
COMMAND = QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE)
NEWEST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
BEAT_PERIOD_S = 0.08


@dataclass
class EmergencyStop:
    """State of the emergency stop, and who last changed it."""

    pressed: bool = False
    by: str = ''
    """The user of this console who last changed it; empty if another node did, or no one."""
    heard: bool = False
    """Whether any state was received or set yet."""

    def say(self, pressed: bool, by: str) -> None:
        """
        Record that a user of this console presses or releases the emergency stop.

        Parameters
        ----------
        pressed
            The new state: whether it is pressed.
        by
            The name of the user.

        """
        self.pressed, self.by, self.heard = pressed, by, True

    def hear(self, pressed: bool) -> None:
        """
        Update the state of the emergency stop from its topic, whichever node has published.

        The echo of a message published by this console keeps the name of the user.

        Parameters
        ----------
        pressed
            Whether the message reports that it is pressed.

        """
        if pressed != self.pressed or not self.heard:
            self.say(pressed, '')


class RobotLink:
    """
    The emergency stop of a robot, its stop state, and the heartbeat of the console.

    Messages are published at once, from the calling thread. The link exists as long as the node,
    so that late-joining subscribers also receive a stop. Nothing is published at startup, since a
    message with false would release a stop.

    Parameters
    ----------
    node
        The node that publishes and subscribes.
    namespace
        The namespace of the robot, without leading and trailing slashes; '' for that of the node.

    Attributes
    ----------
    control
        The arbitration of the control of the robot.
    stop
        The state of the emergency stop.
    people
        The names of the users who have a page of the robot open.
    mover
        The session that publishes velocities, or did last.
    stop_topic, state_topic
        The topics of the emergency stop (Bool) and of the robot's stop state (String).

    """

    def __init__(self, node: Node, namespace: str) -> None:
        self._node = node
        self.control = Control()
        self.stop = EmergencyStop()
        self.people = People()
        self.mover: object = None
        self.stop_topic = below(namespace, 'emergency_stop')
        self.state_topic = below(namespace, 'stop_state')
        self.holds_because = ''
        """The last reported reason why the robot holds still; empty if it moves or is silent."""
        self._beat_s = -1.0
        self._stop_publisher = node.create_publisher(Bool, self.stop_topic, LATCHED)
        self._beat_publisher = node.create_publisher(
            Bool, below(namespace, 'console_heartbeat'), NEWEST
        )
        quiet = SubscriptionEventCallbacks(use_default_callbacks=False)
        for qos in (LATCHED, NEWEST):  # NEWEST also matches volatile and best-effort publishers
            node.create_subscription(Bool, self.stop_topic, self._hear, qos, event_callbacks=quiet)
        node.create_subscription(String, self.state_topic, self._hear_answer, LATCHED)

    def say_stop(self, pressed: bool, by: str) -> None:
        """
        Publish a press or release of the emergency stop.

        Parameters
        ----------
        pressed
            True to press it.
        by
            The name of the user.

        """
        self.stop.say(pressed, by)
        self._stop_publisher.publish(Bool(data=pressed))

    def beat(self, in_control: bool) -> None:
        """
        Publish a heartbeat of the console.

        While a user is in control, heartbeats within 0.08 s of the last one are dropped.

        Parameters
        ----------
        in_control
            Whether a user is in control; False informs the robot that control was released
            intentionally.

        """
        now_s = time.monotonic()
        if not in_control or now_s - self._beat_s >= BEAT_PERIOD_S:
            self._beat_s = now_s
            self._beat_publisher.publish(Bool(data=in_control))

    def stop_publishers(self) -> set[str]:
        """Return the names of the other nodes that publish the emergency stop."""
        ends = self._node.get_publishers_info_by_topic(self.stop_topic)
        return node_names(ends) - {self._node.get_fully_qualified_name()}

    def _hear(self, message: Bool) -> None:
        self.stop.hear(message.data)

    def _hear_answer(self, message: String) -> None:
        self.holds_because = message.data


def node_names(ends: Iterable[Any]) -> set[str]:
    """
    Return the fully qualified names of the nodes of publishers or subscriptions.

    Parameters
    ----------
    ends
        The `TopicEndpointInfo` of each.

    """
    return {f'{end.node_namespace.rstrip("/")}/{end.node_name}' for end in ends}


_LINKS: WeakKeyDictionary[Page, dict[str, RobotLink]] = WeakKeyDictionary()


def link_of(context: Context, namespace: str) -> RobotLink:
    """
    Return the link to a robot, which all panels of a page share; it is created on first use.

    Parameters
    ----------
    context
        The context of the panel, with its page and its node.
    namespace
        The namespace of the robot; leading and trailing slashes are ignored.

    """
    links = _LINKS.setdefault(context.page, {})
    name = namespace.strip('/')
    if name not in links:
        links[name] = RobotLink(context.node, name)
    return links[name]
