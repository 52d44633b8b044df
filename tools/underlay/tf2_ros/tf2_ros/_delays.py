# SPDX-License-Identifier: Apache-2.0
"""Statistics of the delay and rate of transforms."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

# Messages do not contain the node that published them.
AUTHORITY = '<no authority available>'


@dataclass
class Delays:
    """Delay statistics of a frame or broadcaster."""

    count: int = 0
    sum_s: float = 0.0
    longest_s: float = 0.0

    def add(self, delay_s: float) -> None:
        """
        Record the delay of one transform.

        Parameters
        ----------
        delay_s
            Receive time minus time stamp, in s; negative for a stamp in the future.

        """
        self.count += 1
        self.sum_s += delay_s
        self.longest_s = max(self.longest_s, delay_s) if self.count > 1 else delay_s

    @property
    def mean_s(self) -> float:
        """Return the mean delay."""
        return self.sum_s / self.count if self.count else 0.0

    def __str__(self) -> str:
        """Format the mean and the maximum delay as in tf2_monitor."""
        return f'Average Delay: {self.mean_s:.6g}, Max Delay: {self.longest_s:.6g}'


@dataclass
class Traffic:
    """Transforms received since the start of a period."""

    frames: dict[str, Delays] = field(default_factory=dict)
    total: Delays = field(default_factory=Delays)
    net: Delays = field(default_factory=Delays)
    messages: int = 0

    def add(self, delays_s: Iterable[tuple[str, float]]) -> None:
        """
        Record the transforms of one message.

        Parameters
        ----------
        delays_s
            Child frame and delay in s of each transform in the message.

        """
        self.messages += 1
        for frame, delay_s in delays_s:
            self.frames.setdefault(frame, Delays()).add(delay_s)
            self.total.add(delay_s)


def report(traffic: Traffic, static: Iterable[str], chain: list[str], duration_s: float) -> str:
    """
    Format the table of delays and rates that tf2_monitor prints.

    Parameters
    ----------
    traffic
        The transforms received during the period.
    static
        Child frames of `/tf_static`, which are listed with a delay of 0.
    chain
        Frames between the source and the target, to list only these; empty for all frames.
    duration_s
        Length of the period, in s.

    """
    frames = {**dict.fromkeys(static, Delays()), **traffic.frames}
    rows = [
        f'Frame: {frame}, published by {AUTHORITY}, {delays}'
        for frame, delays in sorted(frames.items())
        if not chain or frame in chain
    ]
    node = f'Node: {AUTHORITY} {traffic.messages / duration_s:.6g} Hz, {traffic.total}'
    return '\n'.join(
        [*_title(traffic, chain), '', 'Frames:', *rows, '', 'All Broadcasters:', node, '']
    )


def _title(traffic: Traffic, chain: list[str]) -> list[str]:
    if not chain:
        return ['RESULTS: for all Frames']
    return [
        f'RESULTS: for {chain[0]} to {chain[-1]}',
        f'Chain is: {" -> ".join(chain)}',
        f'Net delay     avg = {traffic.net.mean_s:.6g}: max = {traffic.net.longest_s:.6g}',
    ]
