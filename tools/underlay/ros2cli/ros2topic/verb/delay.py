# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 topic delay`, and how it measures delays."""

from __future__ import annotations

import argparse
from collections import deque
from math import sqrt
from typing import Any

from ros2cli.arguments import add_strategy_arguments, positive_int
from ros2topic.verb import VerbExtension

DEFAULT_WINDOW = 10000


class DelayVerb(VerbExtension):
    """Display delay of topic from timestamp in header."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the topic and the number of messages to measure over.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 topic delay`; unused.

        """
        add_strategy_arguments(parser)
        parser.add_argument('topic_name', help='Topic name to calculate the delay for')
        parser.add_argument(
            '-w',
            '--window',
            type=positive_int,
            default=DEFAULT_WINDOW,
            metavar='WINDOW',
            help='window size, in number of messages, for calculating delay '
            '(default: %(default)s)',
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the delay since the header's time stamp every second until the user stops it.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2cli.names import absolute
        from ros2cli.node.direct import DirectNode
        from ros2topic.api.subscribing import report_for_ever, subscribe_when_published

        topic = absolute(args.topic_name)
        meter = DelayMeter(args.window)
        with DirectNode(args) as node:

            def count(message: Any, received_s: float) -> None:
                now_s = node.get_clock().now().nanoseconds / 1e9
                meter.add((now_s if args.use_sim_time else received_s) - _stamp_s(message))

            watched = subscribe_when_published(
                node, topic, count, raw=False, check=_require_header
            )
            report_for_ever(node, topic, meter.report, watched)
        return None


def _require_header(message_type: Any) -> None:
    if 'header' not in message_type.get_fields_and_field_types():
        raise RuntimeError('msg does not have header')


def _stamp_s(message: Any) -> float:
    stamp = message.header.stamp
    return float(stamp.sec + stamp.nanosec / 1e9)


class DelayMeter:
    """
    Measures the mean, extremes and standard deviation of the last delays.

    Parameters
    ----------
    window
        The number of delays to keep.

    """

    def __init__(self, window: int) -> None:
        self._delays_s: deque[float] = deque(maxlen=window)
        self._changed = False

    def add(self, delay_s: float) -> None:
        """
        Count a message.

        Parameters
        ----------
        delay_s
            From its header's time stamp to its arrival, in s.

        """
        self._delays_s.append(delay_s)
        self._changed = True

    def report(self) -> str:
        """Return the two lines of a report, or '' without new messages since the last one."""
        if not self._changed:
            return ''
        self._changed = False
        delays = self._delays_s
        mean = sum(delays) / len(delays)
        spread = sqrt(sum((delay - mean) ** 2 for delay in delays) / len(delays))
        return (
            f'average delay: {mean:.3f}\n\tmin: {min(delays):.3f}s max: {max(delays):.3f}s '
            f'std dev: {spread:.5f}s window: {len(delays)}'
        )
