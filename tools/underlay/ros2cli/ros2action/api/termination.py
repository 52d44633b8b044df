# SPDX-License-Identifier: Apache-2.0
"""Handling of SIGINT and SIGTERM as requests, to allow a clean shutdown."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import signal

from rclpy.executors import ExternalShutdownException

EXCEPTIONS = {signal.SIGINT: KeyboardInterrupt, signal.SIGTERM: ExternalShutdownException}


@contextmanager
def signals_as_requests() -> Iterator[Callable[[], None]]:
    """
    Handle SIGINT and SIGTERM, and yield a function that raises for the oldest pending one.

    rclpy would shut all communication down at SIGTERM, and an exception inside of a callback or a
    wait loses the message just taken. So callers poll for signals between two steps of work.
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
