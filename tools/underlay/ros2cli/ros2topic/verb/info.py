# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 topic info`."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.arguments import add_strategy_arguments
from ros2topic.verb import VerbExtension


class InfoVerb(VerbExtension):
    """Print information about a topic."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the name of the topic and the option for details.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 topic info`; unused.

        """
        add_strategy_arguments(parser)
        parser.add_argument(
            'topic_name', help="Name of the ROS topic to get info (e.g. '/chatter')"
        )
        parser.add_argument(
            '-v',
            '--verbose',
            action='store_true',
            help='Prints detailed information like the node name, node namespace, topic type, '
            'GID, and QoS Profile of the publishers and subscribers to this topic',
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the type of the topic and its publishers and subscriptions.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        Returns
        -------
        str or None
            The error message if the topic is unknown.

        """
        from ros2cli.node.strategy import NodeStrategy
        from ros2topic.api import get_topic_types, unknown_topic_text

        def find(graph: Any) -> list[str]:
            return get_topic_types(graph, args.topic_name)

        with NodeStrategy(args, find) as node:
            types = find(node)
            if not types:
                return unknown_topic_text(node, args.topic_name)
        line_end = '\n' if args.verbose else ''
        print('Type:', types[0] if len(types) == 1 else types, end=f'\n{line_end}')
        print('Publisher count:', node.count_publishers(args.topic_name), end=f'\n{line_end}')
        if args.verbose:
            _print_endpoints(node.get_publishers_info_by_topic(args.topic_name))
        print('Subscription count:', node.count_subscribers(args.topic_name), end=f'\n{line_end}')
        if args.verbose:
            _print_endpoints(node.get_subscriptions_info_by_topic(args.topic_name))
        return None


def _print_endpoints(endpoints: list[Any]) -> None:
    for endpoint in endpoints:
        print(endpoint, end='\n\n')
