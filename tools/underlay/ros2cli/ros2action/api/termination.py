# SPDX-License-Identifier: Apache-2.0
"""SIGINT and SIGTERM as requests, so that there is time for some last words."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import signal

from rclpy.executors import ExternalShutdownException

EXCEPTIONS = {signal.SIGINT: KeyboardInterrupt, signal.SIGTERM: ExternalShutdownException}


@contextmanager
def signals_as_requests() -> Iterator[Callable[[], None]]:
    """
    Take SIGINT and SIGTERM over, and yield a function that raises for the oldest not yet raised.

    rclpy would cut off all communication at SIGTERM; and an exception in the middle of its work
    loses the message that it has just taken. So one asks, between two pieces of work.
    """
    received: list[int] = []

    def remember(number: int, _: object) -> None:
        received.append(number)

    def check() -> None:
        if received:
            raise EXCEPTIONS[signal.Signals(received.pop(0))]

    before = {number: signal.signal(number, remember) for number in EXCEPTIONS}
    try:
        yield check
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
    check()
