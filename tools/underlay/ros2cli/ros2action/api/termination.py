# SPDX-License-Identifier: Apache-2.0
"""SIGTERM as an exception, so that there is time for some last words."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import signal
from typing import NoReturn

from rclpy.executors import ExternalShutdownException


@contextmanager
def sigterm_as_exception() -> Iterator[None]:
    """Take SIGTERM over from rclpy, which would cut off all communication at once."""
    before = signal.signal(signal.SIGTERM, _raise)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _raise(*_: object) -> NoReturn:
    raise ExternalShutdownException
