# SPDX-License-Identifier: Apache-2.0
"""The traffic of the bag benchmark: numbered joint states."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import subprocess
import time
from typing import Any

from measuring import own_node
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import QoSProfile
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState

TYPE = 'sensor_msgs/msg/JointState'
JOINTS = 26
DEPTH = 1000
TIMEOUT_S = 60.0
SILENCE_S = 1.0


class Traffic:
    """
    A node that sends serialized messages on some topics, or records when it receives them.

    To send, call `connect` first; to receive, `listen` and then `hear`.

    Parameters
    ----------
    node
        The node of rclpy.
    topics
        The names of the topics, whose messages are joint states.

    Attributes
    ----------
    sent, received
        Topic, serialized message and time in ns of each message.

    """

    def __init__(self, node: Any, topics: list[str]) -> None:
        self._node = node
        self._topics = topics
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(node)
        self._publishers: dict[str, Any] = {}
        self.sent: list[tuple[str, bytes, int]] = []
        self.received: list[tuple[str, bytes, int]] = []

    def connect(self) -> None:
        """Create the publishers, and wait until each has a subscriber."""
        self._publishers = {
            topic: self._node.create_publisher(JointState, topic, QoSProfile(depth=DEPTH))
            for topic in self._topics
        }
        self.sent = []
        end = time.monotonic() + TIMEOUT_S
        while not all(each.get_subscription_count() for each in self._publishers.values()):
            if time.monotonic() > end:
                raise TimeoutError('nobody subscribed')
            time.sleep(0.01)

    def send(self, rate_hz: float, seconds: float) -> None:
        """
        Publish joint states at a fixed rate, on the topics in turn.

        Parameters
        ----------
        rate_hz
            The number of messages per second, on all topics together.
        seconds
            The duration.

        """
        begin_s = time.monotonic()
        for number in range(int(rate_hz * seconds)):
            topic, data = self._topics[number % len(self._topics)], joint_states(number)
            time.sleep(max(0.0, begin_s + number / rate_hz - time.monotonic()))
            self.sent.append((topic, data, time.time_ns()))
            self._publishers[topic].publish(data)

    def disconnect(self) -> None:
        """Destroy the publishers."""
        for publisher in self._publishers.values():
            self._node.destroy_publisher(publisher)

    def listen(self) -> None:
        """Subscribe to the topics."""
        for topic in self._topics:
            self._node.create_subscription(
                JointState, topic, self._receiver(topic), QoSProfile(depth=DEPTH), raw=True
            )

    def hear(self, process: subprocess.Popen[bytes]) -> None:
        """
        Record what arrives until `SILENCE_S` after the end of a process.

        Parameters
        ----------
        process
            The player of a bag.

        """
        self.received = []
        last_s = time.monotonic()
        while process.poll() is None or time.monotonic() < last_s + SILENCE_S:
            if process.poll() is None:
                last_s = time.monotonic()
            self._executor.spin_once(timeout_sec=0.1)

    def _receiver(self, topic: str) -> Any:
        def receive(data: bytes, info: dict[str, int]) -> None:
            self.received.append((topic, data, info['received_timestamp']))

        return receive


@contextmanager
def traffic(topics: list[str]) -> Iterator[Traffic]:
    """
    Run a node that sends or receives during a `with` block.

    Parameters
    ----------
    topics
        The names of its topics.

    Yields
    ------
    Traffic
        The node, without publishers and subscriptions yet.

    """
    with own_node('bag_traffic') as node:
        yield Traffic(node, topics)


def joint_states(number: int) -> bytes:
    """
    Serialize a joint state message of about a kilobyte.

    Parameters
    ----------
    number
        A number that makes the message unique; it is also its stamp, in s.

    """
    message = JointState(name=[f'joint_number_{index}' for index in range(JOINTS)])
    message.position = message.velocity = [number / (index + 1) for index in range(JOINTS)]
    message.header.stamp.sec = number
    return serialize_message(message)
