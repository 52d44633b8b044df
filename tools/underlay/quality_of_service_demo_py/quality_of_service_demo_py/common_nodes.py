# SPDX-License-Identifier: Apache-2.0
"""What the demos share: the talker, the listener, and how a program runs both."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Coroutine, Sequence
from itertools import count
from typing import Any

from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.task import Future
from std_msgs.msg import String
from tf2_ros.executing import sleep
from tf2_ros.program import number_in, run, spin

__all__ = ['Listener', 'Talker', 'milliseconds', 'run_demo']

PERIOD_S = 0.5
LONGEST_MS = 1e9


class Talker(Node):
    """
    Publishes a text with a number.

    Parameters
    ----------
    topic
        The name of the topic.
    qos
        The quality of service that it offers.
    events
        What is called when the quality of service is not kept.
    last
        The number of messages after which it stops; without one, it goes on.
    period_s
        The time between two messages, in s.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(
        self,
        topic: str,
        qos: QoSProfile,
        events: PublisherEventCallbacks | None = None,
        *,
        last: int | None = None,
        period_s: float = PERIOD_S,
        **options: Any,
    ) -> None:
        super().__init__('talker', **options)
        self.publisher = self.create_publisher(String, topic, qos, event_callbacks=events)
        self._numbers = iter(count() if last is None else range(last))
        self._timer = self.create_timer(period_s, self.publish)

    def publish(self) -> None:
        """Publish the next message, or stop after the last one."""
        number = next(self._numbers, None)
        if number is None:
            self._timer.cancel()
            return
        message = String(data=f'Talker says {number}')
        self.get_logger().info(f'Publishing: "{message.data}"')
        self.publisher.publish(message)

    def stop(self) -> None:
        """Publish no more, until `go_on` is called."""
        self._timer.cancel()

    def go_on(self) -> None:
        """Publish again."""
        self._timer.reset()


class Listener(Node):
    """
    Logs what it hears.

    Parameters
    ----------
    topic
        The name of the topic.
    qos
        The quality of service that it requests.
    events
        What is called when the quality of service is not kept.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(
        self,
        topic: str,
        qos: QoSProfile,
        events: SubscriptionEventCallbacks | None = None,
        **options: Any,
    ) -> None:
        super().__init__('listener', **options)
        self._topic, self._qos, self._events = topic, qos, events

    def start_listening(self) -> None:
        """Subscribe to the topic."""
        self.create_subscription(
            String, self._topic, self.listen, self._qos, event_callbacks=self._events
        )

    async def start_listening_after(self, delay_s: float) -> None:
        """
        Subscribe to the topic later.

        Parameters
        ----------
        delay_s
            The time until then, in s.

        """
        await sleep(self, delay_s)
        self.get_logger().info('Subscribing')
        self.start_listening()

    def listen(self, message: String) -> None:
        """
        Log a message.

        Parameters
        ----------
        message
            The message.

        """
        self.get_logger().info(f'I heard: "{message.data}"')


def milliseconds(text: str) -> float:
    """
    Convert an argument in ms to s.

    Parameters
    ----------
    text
        The argument.

    Raises
    ------
    argparse.ArgumentTypeError
        It is not a number from 0 on.

    """
    return number_in(0.0, LONGEST_MS, 'time in ms')(text) / 1000.0


def run_demo(
    parser: ArgumentParser,
    make: Callable[[Namespace], Sequence[Node]],
    argv: Sequence[str] | None,
    task: Callable[..., Coroutine[Any, Any, object]] | None = None,
    *,
    ends: bool = False,
) -> int:
    """
    Run nodes until SIGINT or SIGTERM; return the exit status.

    Parameters
    ----------
    parser
        Parses the command line.
    make
        Makes the nodes from the parsed command line.
    argv : Sequence[str] | None
        The command line including the program name; by default that of the process.
    task
        A coroutine function that gets the parsed command line and the nodes.
    ends
        Whether the program ends when the task has returned.

    """

    def work(options: Namespace) -> None:
        nodes = first, *others = make(options)
        first.companions = tuple(others)

        async def act() -> None:
            if task is not None:
                await task(options, *nodes)
            if not ends:
                await Future(executor=first.executor)

        spin(first, task=act)
        for node in nodes:
            node.destroy_node()

    return run(parser.parse_args, work, argv)
