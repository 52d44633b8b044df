# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 topic delay`."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.argument_types import positive_int
from ros2cli.node.arguments import add_strategy_arguments
from ros2topic.api.delay import DelayMeter
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
        from ros2topic.api.reporting import report_for_ever
        from ros2topic.api.watching import subscribe_when_published

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
