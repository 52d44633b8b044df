# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 topic hz`."""

from __future__ import annotations

import argparse

from ros2cli.argument_types import positive_int
from ros2cli.node.arguments import add_strategy_arguments
from ros2topic.api.filter_argument import add_filter_argument
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
        from ros2topic.api.hz import print_rate

        with DirectNode(args) as node:
            print_rate(node, absolute(args.topic_name), args)
        return None
