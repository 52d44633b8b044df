# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 topic hz`, and how it measures a rate."""

from __future__ import annotations

import argparse
from collections import deque
from math import sqrt
from typing import Any

from ros2cli.arguments import add_strategy_arguments, positive_int
from ros2topic.api.arguments import add_filter_argument
from ros2topic.verb import VerbExtension

DEFAULT_WINDOW = 10000


class HzVerb(VerbExtension):
    """Print the average publishing rate to screen."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the topic, the number of messages to measure over, the filter and the clock.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 topic hz`; unused.

        """
        add_strategy_arguments(parser)
        parser.add_argument(
            'topic_name', help="Name of the ROS topic to listen to (e.g. '/chatter')"
        )
        parser.add_argument(
            '-w',
            '--window',
            type=positive_int,
            default=DEFAULT_WINDOW,
            metavar='WINDOW',
            help='window size, in number of messages, for calculating rate (default: %(default)s)',
        )
        add_filter_argument(parser, 'count')
        parser.add_argument(
            '--wall-time',
            action='store_true',
            help='calculates rate using wall time, also with --use-sim-time',
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the rate of the topic every second until the user stops it.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2cli.names import absolute
        from ros2cli.node.direct import DirectNode

        with DirectNode(args) as node:
            _print_rate(node, absolute(args.topic_name), args)
        return None


def _print_rate(node: Any, topic: str, args: argparse.Namespace) -> None:
    """
    Print the rate of a topic about once a second, endlessly.

    Parameters
    ----------
    node
        The `DirectNode` that subscribes.
    topic
        Full name of the topic.
    args : argparse.Namespace
        The parsed command line of `ros2 topic hz`.

    Raises
    ------
    RuntimeError
        The topic has several types, or the filter does not fit the messages.

    """
    from ros2topic.api.subscribing import report_for_ever, subscribe_when_published

    meter = RateMeter(args.window)
    clock = node.get_clock() if args.use_sim_time and not args.wall_time else None

    def count(message: Any, received_s: float) -> None:
        if not args.filter or args.filter(message):
            meter.add(clock.now().nanoseconds / 1e9 if clock else received_s)

    watched = subscribe_when_published(node, topic, count, raw=not args.filter)
    report_for_ever(node, topic, meter.report, watched)


class RateMeter:
    """
    Measures the mean rate of events, with the extremes and standard deviation of the periods.

    Parameters
    ----------
    window
        The number of periods to keep.

    """

    def __init__(self, window: int) -> None:
        self._periods_s: deque[float] = deque(maxlen=window)
        self._last_s: float | None = None
        self._changed = False

    def add(self, now_s: float) -> None:
        """
        Count an event; a clock that jumps back restarts the measurement.

        Parameters
        ----------
        now_s
            The time of the event, in s, on any clock.

        """
        if self._last_s is not None and now_s < self._last_s:
            self._periods_s.clear()
            self._changed = False
        elif self._last_s is not None:
            self._periods_s.append(now_s - self._last_s)
            self._changed = True
        self._last_s = now_s

    def report(self) -> str:
        """Return the two lines of a report, or '' without new events since the last one."""
        if not self._changed:
            return ''
        self._changed = False
        periods = self._periods_s
        mean = sum(periods) / len(periods)
        rate = 1.0 / mean if mean > 0.0 else 0.0
        spread = sqrt(sum((period - mean) ** 2 for period in periods) / len(periods))
        return (
            f'average rate: {rate:.3f}\n\tmin: {min(periods):.3f}s max: {max(periods):.3f}s '
            f'std dev: {spread:.5f}s window: {len(periods) + 1}'
        )
