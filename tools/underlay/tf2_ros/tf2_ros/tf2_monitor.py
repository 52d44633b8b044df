# SPDX-License-Identifier: Apache-2.0
"""Print delays and rates of transforms: `ros2 run tf2_ros tf2_monitor`."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from dataclasses import dataclass, field
import sys
import time
from typing import Any

from tf2_ros.program import number_in, run, spin

_PERIOD_S = 10.0

# Messages do not contain the node that published them.
_AUTHORITY = '<no authority available>'


def main() -> int:
    """Run the program; return the exit status."""
    return run(_arguments, _monitor)


def _arguments(words: list[str]) -> argparse.Namespace:
    parser = _parser()
    args = parser.parse_args(words)
    if args.source_frame and not args.target_frame:
        parser.error('give two frames to monitor the chain between them, or none for all')
    return args


def _monitor(args: argparse.Namespace) -> None:
    spin(Monitor(args).node)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='tf2_monitor',
        allow_abbrev=False,
        description='Print the delay and the rate of transforms every 10 s: of all frames, or of '
        'the chain between two.',
    )
    parser.add_argument('source_frame', nargs='?', default='')
    parser.add_argument('target_frame', nargs='?', default='')
    seconds = number_in(0.01, 1e6, 'period in seconds')
    parser.add_argument('--period', type=seconds, default=_PERIOD_S, help='seconds per report')
    return parser


class Monitor:
    """
    Measures the delay and rate of transforms and prints a report for each period.

    Parameters
    ----------
    args : argparse.Namespace
        The command line: source_frame and target_frame, both '' for all frames, and period in s.

    Attributes
    ----------
    node
        The node, to be spun by the caller.

    """

    def __init__(self, args: argparse.Namespace) -> None:
        from rclpy.clock import Clock, ClockType
        from rclpy.node import Node
        from tf2_msgs.msg import TFMessage
        from tf2_ros.buffer import Buffer
        from tf2_ros.transform_broadcaster import DYNAMIC, STATIC_LISTENER

        self._frames = (args.target_frame, args.source_frame)
        self._traffic = Traffic()
        self._static: set[str] = set()
        self._begin_s = time.monotonic()
        self.node = Node('tf2_monitor')
        self._buffer = Buffer()
        self._buffer.follow_clock_of(self.node)
        self.node.create_subscription(TFMessage, '/tf', self._take, DYNAMIC)
        self.node.create_subscription(TFMessage, '/tf_static', self._take_static, STATIC_LISTENER)
        clock = Clock(clock_type=ClockType.STEADY_TIME)
        self.node.create_timer(args.period, self._print, clock=clock)
        what = f'{args.source_frame} -> {args.target_frame}' if args.source_frame else 'all frames'
        print(f'Gathering data on {what} for {args.period:g} seconds...', flush=True)

    def _take(self, message: Any) -> None:
        """Record the delays of the transforms of a message, and buffer them."""
        now_s = self._now_s()
        for transform in message.transforms:
            self._buffer.set_transform(transform, _AUTHORITY)
        self._traffic.add(
            (item.child_frame_id, now_s - _stamp_s(item)) for item in message.transforms
        )
        if all(self._frames):
            self._add_net_delay(now_s)

    def _take_static(self, message: Any) -> None:
        """Buffer static transforms, which have no delay."""
        for transform in message.transforms:
            self._buffer.set_transform_static(transform, _AUTHORITY)
            self._static.add(transform.child_frame_id)

    def _add_net_delay(self, now_s: float) -> None:
        """Record the age of the latest transform between the two frames."""
        from tf2_py import TransformException

        try:
            common_time = self._buffer.get_latest_common_time(*self._frames)
        except TransformException:
            return
        if common_time.nanoseconds:
            self._traffic.net.add(now_s - common_time.nanoseconds / 1e9)

    def _print(self) -> None:
        """Print the statistics since the last report."""
        from tf2_py import TransformException

        try:
            chain = self._chain() if all(self._frames) else []
        except TransformException as error:
            frames = f'{self._frames[1]} and {self._frames[0]}'
            text = f'Waiting for transform chain to become available between {frames}: {error}'
        else:
            now_s = time.monotonic()
            text = '\n' + report(self._traffic, self._static, chain, now_s - self._begin_s)
            self._traffic, self._begin_s = Traffic(), now_s
        print(text, flush=True)

    def _chain(self) -> list[str]:
        from rclpy.time import Time

        target, source = self._frames
        return self._buffer.known_frames.chain(target, Time(), source, Time(), source)

    def _now_s(self) -> float:
        return float(self.node.get_clock().now().nanoseconds / 1e9)


def _stamp_s(transform: Any) -> float:
    stamp = transform.header.stamp
    return float(stamp.sec + stamp.nanosec / 1e9)


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
        f'Frame: {frame}, published by {_AUTHORITY}, {delays}'
        for frame, delays in sorted(frames.items())
        if not chain or frame in chain
    ]
    node = f'Node: {_AUTHORITY} {traffic.messages / duration_s:.6g} Hz, {traffic.total}'
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


if __name__ == '__main__':
    sys.exit(main())
