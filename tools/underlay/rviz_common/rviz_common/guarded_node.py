# SPDX-License-Identifier: Apache-2.0
"""A node that survives failing callbacks."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import functools
import inspect
import time
from typing import Any

from rclpy.node import Node
from rviz_common.pace import Pace
from rviz_common.polled_topic import WaitingGroup
from rviz_common.status import described_error

__all__ = ['GuardedNode']

REPEAT_S = 10.0


class GuardedNode(Node):
    """
    A node that survives an exception in a callback of a subscription or a timer.

    The exception is logged, together with the callback that raised it.
    """

    @property
    def subscriptions(self) -> Iterator[Any]:
        """The subscriptions that an executor serves: those that are not polled."""
        for each in super().subscriptions:
            if not isinstance(each.callback_group, WaitingGroup):
                yield each

    def create_subscription(
        self, msg_type: Any, topic: str, callback: Callable[..., Any], *args: Any, **more: Any
    ) -> Any:
        """
        Create a subscription whose callback may fail: the error is logged, at most every 10 s.

        Parameters
        ----------
        msg_type, topic
            As for `rclpy.node.Node.create_subscription`.
        callback
            Receives the message. One that does not accept a single argument also gets the message
            info: a `received_timestamp` in ns of the system clock, and a `source_timestamp` of 0.
        *args, **more
            The other arguments of `rclpy.node.Node.create_subscription`.

        Returns
        -------
        Any
            The subscription.

        """
        guarded = self._guarded(_with_info(callback), f"The callback of '{topic}'")
        return super().create_subscription(msg_type, topic, guarded, *args, **more)

    def create_timer(
        self, timer_period_sec: float, callback: Callable[[], Any], *args: Any, **more: Any
    ) -> Any:
        """
        Create a timer whose callback may fail: the error is logged, at most every 10 s.

        Parameters
        ----------
        timer_period_sec
            The period, in s.
        callback
            Called without arguments.
        *args, **more
            The other arguments of `rclpy.node.Node.create_timer`.

        Returns
        -------
        Any
            The timer.

        """
        guarded = self._guarded(callback, 'A timer callback')
        return super().create_timer(timer_period_sec, guarded, *args, **more)

    def _guarded(self, callback: Callable[..., Any], subject: str) -> Callable[..., Any]:
        pace = Pace(REPEAT_S)

        @functools.wraps(callback)
        def guarded(*args: Any) -> None:
            try:
                callback(*args)
            except Exception as error:  # a failing callback must not stop the others
                if pace.is_due():
                    said = f'{subject} has raised an error: {described_error(error)}'
                    self.get_logger().error(said)

        return guarded


def _with_info(callback: Callable[..., Any]) -> Callable[..., Any]:
    """
    Add the time of reception to a callback that accepts message info.

    The EventsExecutor of rclpy 7.1 provides no message info, and fails.
    """
    try:
        inspect.signature(callback).bind(None)
    except TypeError:
        pass
    else:
        return callback

    def call(message: Any) -> None:
        callback(message, {'received_timestamp': time.time_ns(), 'source_timestamp': 0})

    return call
