# SPDX-License-Identifier: Apache-2.0
"""Diagnostic tasks that watch how often something happens, and how old messages are."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
import math
from threading import Lock
import time
from typing import Any

from diagnostic_msgs.msg import DiagnosticStatus
from diagnostic_updater.status_wrapper import DiagnosticStatusWrapper
from diagnostic_updater.tasks import DiagnosticTask
from rclpy.clock import Clock

__all__ = [
    'FrequencyStatus',
    'FrequencyStatusParam',
    'Heartbeat',
    'TimeStampStatus',
    'TimeStampStatusParam',
]


class FrequencyStatusParam:
    """
    What `FrequencyStatus` accepts.

    Parameters
    ----------
    freq_bound
        The bounds in Hz: {'min': 0.5, 'max': 2.0}. Changes take effect at once.
    tolerance
        By what part of them frequencies may be outside of the bounds.
    window_size
        Over how many diagnostics the frequency is averaged.

    """

    def __init__(
        self, freq_bound: dict[str, float], tolerance: float = 0.1, window_size: int = 5
    ) -> None:
        self.freq_bound = freq_bound
        self.tolerance = tolerance
        self.window_size = window_size


class FrequencyStatus(DiagnosticTask):
    """
    Watches how often something happens. Call `tick` when it does.

    Parameters
    ----------
    params
        What is accepted.
    name
        The name of the task.
    now_s
        The clock, in s; that of the computer by default.

    """

    def __init__(
        self,
        params: FrequencyStatusParam,
        name: str = 'Frequency Status',
        now_s: Callable[[], float] = time.monotonic,
    ) -> None:
        super().__init__(name)
        self.params = params
        self.lock = Lock()
        self._now_s = now_s
        self.clear()

    def clear(self) -> None:
        """Begin anew: forget what has happened."""
        with self.lock:
            self.count = 0
            start = (self._now_s(), 0)
            self._window = deque([start], maxlen=max(1, self.params.window_size))

    def tick(self) -> None:
        """Count one more event."""
        with self.lock:
            self.count += 1

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """
        Report the frequency.

        Parameters
        ----------
        stat
            The status to fill in.

        """
        with self.lock:
            now = self._now_s()
            since, before = self._window[0]
            events, duration, total = self.count - before, now - since, self.count
            self._window.append((now, self.count))
        frequency = events / duration if duration > 0.0 else 0.0
        low, high = self.params.freq_bound['min'], self.params.freq_bound['max']
        stat.summary(*self._judge(events, frequency, low, high))
        stat.add('Events in window', events)
        stat.add('Events since startup', total)
        stat.add('Duration of window (s)', f'{duration:.6f}')
        stat.add('Actual frequency (Hz)', f'{frequency:.6f}')
        if low == high:
            stat.add('Target frequency (Hz)', low)
        if low > 0.0:
            stat.add('Minimum acceptable frequency (Hz)', low * (1.0 - self.params.tolerance))
        if math.isfinite(high):
            stat.add('Maximum acceptable frequency (Hz)', high * (1.0 + self.params.tolerance))
        return stat

    def _judge(self, events: int, frequency: float, low: float, high: float) -> tuple[bytes, str]:
        if not events:
            return DiagnosticStatus.ERROR, 'No events recorded.'
        if frequency < low * (1.0 - self.params.tolerance):
            return DiagnosticStatus.WARN, 'Frequency too low.'
        if frequency > high * (1.0 + self.params.tolerance):
            return DiagnosticStatus.WARN, 'Frequency too high.'
        return DiagnosticStatus.OK, 'Frequency as desired.'


class TimeStampStatusParam:
    """
    What `TimeStampStatus` accepts.

    Parameters
    ----------
    min_acceptable, max_acceptable
        How old messages may be, in s; negative for ones from the future.

    """

    def __init__(self, min_acceptable: float = -1.0, max_acceptable: float = 5.0) -> None:
        self.min_acceptable = min_acceptable
        self.max_acceptable = max_acceptable


class TimeStampStatus(DiagnosticTask):
    """
    Watches how old messages are when they arrive or leave. Call `tick` with their time stamps.

    Parameters
    ----------
    params
        What is accepted; from -1 s to 5 s by default.
    name
        The name of the task.
    clock
        The clock of the time stamps; that of the system by default.

    """

    def __init__(
        self,
        params: TimeStampStatusParam | None = None,
        name: str = 'Timestamp Status',
        clock: Any = None,
    ) -> None:
        super().__init__(name)
        self.params = params or TimeStampStatusParam()
        self.lock = Lock()
        self._clock = clock or Clock()
        self.early_count = self.late_count = self.zero_count = 0
        self._forget()

    def _forget(self) -> None:
        self.zero_seen = False
        self.min_delta: float | None = None
        self.max_delta: float | None = None

    def tick(self, stamp: Any) -> None:
        """
        Note the time stamp of a message.

        Parameters
        ----------
        stamp
            The stamp of the header, a time of rclpy, or s.

        """
        stamp_s = _seconds(stamp)
        with self.lock:
            if stamp_s == 0.0:
                self.zero_seen = True
                return
            delta = self._clock.now().nanoseconds * 1e-9 - stamp_s
            self.min_delta = delta if self.min_delta is None else min(self.min_delta, delta)
            self.max_delta = delta if self.max_delta is None else max(self.max_delta, delta)

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """
        Report how old the messages since the last report were.

        Parameters
        ----------
        stat
            The status to fill in.

        """
        with self.lock:
            stat.summary(DiagnosticStatus.OK, 'Timestamps are reasonable.')
            if self.min_delta is None and not self.zero_seen:
                stat.summary(DiagnosticStatus.WARN, 'No data since last update.')
            self._judge(stat)
            if self.min_delta is not None:
                stat.add('Earliest timestamp delay', f'{self.min_delta:.6f}')
                stat.add('Latest timestamp delay', f'{self.max_delta:.6f}')
            stat.add('Earliest acceptable timestamp delay', self.params.min_acceptable)
            stat.add('Latest acceptable timestamp delay', self.params.max_acceptable)
            stat.add('Late diagnostic update count', self.late_count)
            stat.add('Early diagnostic update count', self.early_count)
            stat.add('Zero seen diagnostic update count', self.zero_count)
            self._forget()
        return stat

    def _judge(self, stat: DiagnosticStatusWrapper) -> None:
        if self.min_delta is not None and self.min_delta < self.params.min_acceptable:
            stat.mergeSummary(DiagnosticStatus.ERROR, 'Timestamps too far in future seen.')
            self.early_count += 1
        if self.max_delta is not None and self.max_delta > self.params.max_acceptable:
            stat.mergeSummary(DiagnosticStatus.ERROR, 'Timestamps too far in past seen.')
            self.late_count += 1
        if self.zero_seen:
            stat.mergeSummary(DiagnosticStatus.ERROR, 'Zero timestamp seen.')
            self.zero_count += 1


class Heartbeat(DiagnosticTask):
    """Reports that the node is alive."""

    def __init__(self) -> None:
        super().__init__('Heartbeat')

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """
        Report it.

        Parameters
        ----------
        stat
            The status to fill in.

        """
        stat.summary(DiagnosticStatus.OK, 'Alive')
        return stat


def _seconds(stamp: Any) -> float:
    if hasattr(stamp, 'nanoseconds'):
        return float(stamp.nanoseconds) * 1e-9
    if hasattr(stamp, 'nanosec'):
        return float(stamp.sec) + float(stamp.nanosec) * 1e-9
    return float(stamp)
