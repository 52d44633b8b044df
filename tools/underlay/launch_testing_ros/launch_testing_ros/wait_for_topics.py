# SPDX-License-Identifier: Apache-2.0
"""Wait until messages arrive on topics."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from functools import partial
import os
import threading
from typing import Any, Optional

from launch_testing_ros.message_pump import MessagePump

OnMessage = Callable[[str, Any], Any]


class WaitForTopics:
    """
    Subscribes to topics and waits until a message has arrived on each of them.

    The subscribing node starts immediately. As a context manager, it waits on entry and raises a
    RuntimeError if messages are missing then.

    Parameters
    ----------
    topic_tuples
        The name and type of each topic, and optionally a QoS profile. By default, subscriptions
        are best effort and volatile: they match all publishers, but receive no earlier messages.
    timeout
        The timeout for the messages, in s.
    messages_received_buffer_length
        The number of messages kept for each topic.
    trigger
        Called with the node and the trigger arguments before each wait.
    node_namespace
        The namespace of the node.
    qos_profile
        The QoS profile, or the depth, of the subscriptions to topics without one of their own.
    callback
        Called with the topic name and each message, from the thread that spins the node.
    **trigger_arguments
        The keyword arguments of the trigger.

    """

    def __init__(
        self,
        topic_tuples: Iterable[tuple[Any, ...]],
        timeout: float = 5.0,
        messages_received_buffer_length: int = 10,
        trigger: Optional[Callable[..., Any]] = None,
        node_namespace: Optional[str] = None,
        qos_profile: Any = None,
        callback: Optional[OnMessage] = None,
        **trigger_arguments: Any,
    ) -> None:
        self._timeout = timeout
        self._callback = callback
        self._trigger = partial(trigger, **trigger_arguments) if trigger is not None else None
        self._condition = threading.Condition()
        topics = [(name, message_type, *qos) for name, message_type, *qos in topic_tuples]
        self._messages: dict[str, deque[Any]] = {
            name: deque(maxlen=messages_received_buffer_length) for name, *_ in topics
        }
        self._start(topics, node_namespace, messages_received_buffer_length, qos_profile)

    def _start(
        self,
        topics: list[tuple[Any, ...]],
        namespace: Optional[str],
        depth: int,
        qos_profile: Any,
    ) -> None:
        """Start a node with its own ROS context."""
        import rclpy
        from rclpy.context import Context
        from rclpy.node import Node
        from rclpy.qos import QoSProfile, ReliabilityPolicy

        self._context = Context()
        rclpy.init(args=[], context=self._context)
        self._node = Node(
            f'wait_for_topics_{os.getpid()}_{id(self)}',
            namespace=namespace,
            context=self._context,
            start_parameter_services=False,
            enable_rosout=False,
        )
        any_publisher = QoSProfile(depth=depth, reliability=ReliabilityPolicy.BEST_EFFORT)
        usual = any_publisher if qos_profile is None else qos_profile
        for name, message_type, *qos in topics:
            self._node.create_subscription(
                message_type,
                name,
                partial(self._on_message, name),
                qos[0] if qos else usual,
            )
        self._pump: Optional[MessagePump] = MessagePump(self._node)
        self._pump.start()

    def _on_message(self, name: str, message: Any) -> None:
        with self._condition:
            self._messages[name].append(message)
            self._condition.notify_all()
        if self._callback is not None:
            self._callback(name, message)

    def wait(self) -> bool:
        """Wait for the messages; return whether one has arrived on each topic in time."""
        if self._trigger is not None:
            self._trigger(self._node)
        with self._condition:
            return self._condition.wait_for(lambda: not self._missing(), self._timeout)

    def topics_received(self) -> set[str]:
        """Return the topics on which messages have arrived."""
        return set(self._messages) - self.topics_not_received()

    def topics_not_received(self) -> set[str]:
        """Return the topics on which no messages have arrived."""
        with self._condition:
            return self._missing()

    def received_messages(self, topic_name: str) -> list[Any]:
        """
        Return the last messages on a topic, oldest first.

        Parameters
        ----------
        topic_name
            The topic name as passed to the constructor.

        Raises
        ------
        KeyError
            The topic is not among those passed to the constructor.

        """
        if topic_name not in self._messages:
            raise KeyError(f"'{topic_name}' is not among the topics: {', '.join(self._messages)}")
        with self._condition:
            return list(self._messages[topic_name])

    def shutdown(self) -> None:
        """Destroy the node; the received messages remain available."""
        if self._pump is None:
            return
        self._pump.stop()
        self._pump = None
        self._node.destroy_node()
        self._context.try_shutdown()

    def __enter__(self) -> WaitForTopics:
        if not self.wait():
            missing = ', '.join(sorted(self.topics_not_received()))
            there = ', '.join(sorted(name for name, _ in self._node.get_topic_names_and_types()))
            self.shutdown()
            raise RuntimeError(
                f'Did not receive messages on these topics within {self._timeout:g} s: '
                f'{missing}. The topics there are: {there}'
            )
        return self

    def __exit__(self, *exc_info: Any) -> None:
        self.shutdown()

    def _missing(self) -> set[str]:
        return {name for name, messages in self._messages.items() if not messages}
