# SPDX-License-Identifier: Apache-2.0
"""Deferral of Ctrl-C until a block of code is finished."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import signal
from types import FrameType


@contextmanager
def interrupts_deferred() -> Iterator[None]:
    """
    Raise KeyboardInterrupt only at the end of the block.

    This includes an earlier SIGINT that rclpy has received but Python has not handled yet.
    """
    received: list[int] = []

    def remember(number: int, _: FrameType | None) -> None:
        received.append(number)

    try:
        previous = signal.signal(signal.SIGINT, remember)
    except KeyboardInterrupt:
        remember(signal.SIGINT, None)
        previous = signal.signal(signal.SIGINT, remember)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, previous)
    if received:
        raise KeyboardInterrupt
