# SPDX-License-Identifier: Apache-2.0
"""The bandwidth of a stream of messages."""

from __future__ import annotations

from collections import deque


class BandwidthMeter:
    """Keeps the times and sizes of the last messages."""

    def __init__(self, window: int) -> None:
        """Keep up to `window` messages."""
        self._messages: deque[tuple[float, int]] = deque(maxlen=window)

    def add(self, now_s: float, size: int) -> None:
        """Count a message."""
        self._messages.append((now_s, size))

    def report(self, now_s: float) -> str:
        """Return the two lines of a report, or '' as long as there are too few messages."""
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
    """Return a number of bytes in B, KB or MB."""
    if count < 1e3:
        return f'{count:.0f} B'
    return f'{count / 1e3:.2f} KB' if count < 1e6 else f'{count / 1e6:.2f} MB'
