# SPDX-License-Identifier: Apache-2.0
"""Rate and bandwidth of the messages of a topic."""

from __future__ import annotations

from collections import deque

__all__ = ['RateWindow']

WINDOW_S = 10.0
MOST = 500


class RateWindow:
    """
    Sliding window of the times and sizes of messages, to estimate their rate.

    Parameters
    ----------
    window_s
        The length of the window, in s.
    most
        The maximum number of messages in the window.

    Attributes
    ----------
    count
        The total number of messages received.

    """

    def __init__(self, window_s: float = WINDOW_S, most: int = MOST) -> None:
        self._window_s = window_s
        self._messages: deque[tuple[float, int]] = deque(maxlen=most)
        self.count = 0

    def add(self, time_s: float, size: int) -> None:
        """
        Add a message; if time jumps back, earlier messages are dropped.

        Parameters
        ----------
        time_s
            The time of reception, in s.
        size
            Its size, in bytes.

        """
        if self._messages and time_s < self._messages[-1][0]:
            self._messages.clear()
        self._messages.append((time_s, size))
        self.count += 1

    def age_s(self, now_s: float) -> float | None:
        """
        Return the age of the latest message.

        Parameters
        ----------
        now_s
            The current time, of the same clock.

        Returns
        -------
        float or None
            In s; None if no message was received.

        """
        return max(now_s - self._messages[-1][0], 0.0) if self._messages else None

    def rate_hz(self, now_s: float) -> float | None:
        """
        Estimate the current message rate.

        Parameters
        ----------
        now_s
            The current time, of the same clock.

        Returns
        -------
        float or None
            In Hz; None with fewer than two messages, or after a silence that is long for this
            topic.

        """
        span = self._span(now_s)
        return None if span is None else (len(self._messages) - 1) / span

    def bytes_per_s(self, now_s: float) -> float | None:
        """
        Estimate the current bandwidth.

        Parameters
        ----------
        now_s
            The current time, of the same clock.

        Returns
        -------
        float or None
            In bytes per second; None as for `rate_hz`.

        """
        span = self._span(now_s)
        if span is None:
            return None
        return sum(size for _, size in list(self._messages)[1:]) / span

    def _span(self, now_s: float) -> float | None:
        """Compute the duration covered by the messages, extended by an unusual silence."""
        while len(self._messages) > 2 and now_s - self._messages[0][0] > self._window_s:
            self._messages.popleft()
        if len(self._messages) < 2:
            return None
        first, last = self._messages[0][0], self._messages[-1][0]
        usual = (last - first) / (len(self._messages) - 1)
        silence = now_s - last
        if silence > max(self._window_s, 3.0 * usual):
            return None
        span = last - first + (silence if silence > 3.0 * usual + 0.5 else 0.0)
        return span if span > 0.0 else None
