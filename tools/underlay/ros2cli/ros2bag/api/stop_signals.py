# SPDX-License-Identifier: Apache-2.0
"""Deferred stop signals: work ends between two messages, never in the middle of one."""

from __future__ import annotations

import signal
from types import FrameType, TracebackType
from typing import Any

from rclpy.executors import ExternalShutdownException
from rclpy.signals import uninstall_signal_handlers

__all__ = ['StopSignals']

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class StopSignals:
    """Recorder of SIGINT, SIGTERM and SIGHUP; use it in a `with` statement."""

    def __init__(self) -> None:
        """Initialize without installing handlers."""
        self._first: int | None = None
        self._before: dict[signal.Signals, Any] = {}

    def __enter__(self) -> StopSignals:
        """Replace the signal handlers of rclpy."""
        uninstall_signal_handlers()
        for number in SIGNALS:
            self._before[number] = signal.signal(number, self._note)
        return self

    def __bool__(self) -> bool:
        """Whether a signal has been received."""
        return self._first is not None

    def raise_if_any(self) -> None:
        """Raise the exception of the first signal, for the exit status."""
        if self._first == signal.SIGINT:
            raise KeyboardInterrupt
        if self._first is not None:
            raise ExternalShutdownException

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Restore the previous signal handlers."""
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def _note(self, number: int, frame: FrameType | None) -> None:
        if self._first is None:
            self._first = number
