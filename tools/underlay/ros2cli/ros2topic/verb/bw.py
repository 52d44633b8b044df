# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 topic bw`."""

from __future__ import annotations

import argparse
import time
from typing import Any

from ros2cli.argument_types import positive_int
from ros2cli.node.arguments import add_strategy_arguments
from ros2topic.api.bandwidth import BandwidthMeter
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
        from ros2topic.api.reporting import report_for_ever
        from ros2topic.api.watching import subscribe_when_published

        topic = absolute(args.topic_name)
        meter = BandwidthMeter(args.window)

        def count(data: Any, received_s: float) -> None:
            meter.add(received_s, len(data))

        with DirectNode(args) as node:
            watched = subscribe_when_published(node, topic, count)
            print(f'Subscribed to [{topic}]')
            report_for_ever(node, topic, lambda: meter.report(time.time()), watched)
        return None
