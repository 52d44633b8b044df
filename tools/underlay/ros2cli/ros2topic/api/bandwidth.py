# SPDX-License-Identifier: Apache-2.0
"""The bandwidth of a stream of messages."""

from __future__ import annotations

from collections import deque


class BandwidthMeter:
    """
    Measures the bandwidth of a topic over the last messages.

    Parameters
    ----------
    window
        The number of messages to keep.

    """

    def __init__(self, window: int) -> None:
        self._messages: deque[tuple[float, int]] = deque(maxlen=window)

    def add(self, now_s: float, size: int) -> None:
        """
        Count a message.

        Parameters
        ----------
        now_s
            The arrival time in s, on the same clock as for `report`.
        size
            Its serialized size in bytes.

        """
        self._messages.append((now_s, size))

    def report(self, now_s: float) -> str:
        """
        Format the bandwidth and the sizes of the messages in the window.

        Parameters
        ----------
        now_s
            The current time in s; the bandwidth is the mean since the oldest message.

        Returns
        -------
        str
            Two lines, or '' as long as there are fewer than two messages.

        """
        if len(self._messages) < 2 or now_s <= self._messages[0][0]:
            return ''
        sizes = [size for _, size in self._messages]
        per_second = sum(sizes) / (now_s - self._messages[0][0])
        return (
            f'{human_bytes(per_second)}/s from {len(sizes)} messages\n\tMessage size mean: '
            f'{human_bytes(sum(sizes) / len(sizes))} min: {human_bytes(min(sizes))} '
            f'max: {human_bytes(max(sizes))}'
        )


def human_bytes(count: float) -> str:
    """
    Format a number of bytes in B, KB or MB, with powers of 1000.

    Parameters
    ----------
    count
        The number of bytes, or of bytes per second.

    """
    if count < 1e3:
        return f'{count:.0f} B'
    return f'{count / 1e3:.2f} KB' if count < 1e6 else f'{count / 1e6:.2f} MB'
