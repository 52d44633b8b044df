# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 topic bw`, and how it measures a bandwidth."""

from __future__ import annotations

import argparse
from collections import deque
import time
from typing import Any

from ros2cli.arguments import add_strategy_arguments, positive_int
from ros2topic.verb import VerbExtension

DEFAULT_WINDOW = 100


class BwVerb(VerbExtension):
    """Display bandwidth used by topic."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the topic and the number of messages to measure over.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 topic bw`; unused.

        """
        add_strategy_arguments(parser)
        parser.add_argument('topic_name', help='Topic name to monitor for bandwidth utilization')
        parser.add_argument(
            '-w',
            '--window',
            type=positive_int,
            default=DEFAULT_WINDOW,
            metavar='WINDOW',
            help='maximum window size, in number of messages, for calculating rate '
            '(default: %(default)s)',
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the bandwidth of the topic every second until the user stops it.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2cli.names import absolute
        from ros2cli.node.direct import DirectNode
        from ros2topic.api.subscribing import report_for_ever, subscribe_when_published

        topic = absolute(args.topic_name)
        meter = BandwidthMeter(args.window)

        def count(data: Any, received_s: float) -> None:
            meter.add(received_s, len(data))

        with DirectNode(args) as node:
            watched = subscribe_when_published(node, topic, count)
            print(f'Subscribed to [{topic}]')
            report_for_ever(node, topic, lambda: meter.report(time.time()), watched)
        return None


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
