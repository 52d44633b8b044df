# SPDX-License-Identifier: Apache-2.0
"""Finish something before Ctrl-C ends the command."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import signal
from types import FrameType


@contextmanager
def interrupts_deferred() -> Iterator[None]:
    """
    Raise KeyboardInterrupt only at the end of the block.

    That of a SIGINT before it, of which rclpy has heard but Python has not yet, as well.
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
