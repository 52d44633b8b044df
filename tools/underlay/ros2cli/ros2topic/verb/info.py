# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 topic info`."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.node.arguments import add_strategy_arguments
from ros2topic.verb import VerbExtension


class InfoVerb(VerbExtension):
    """Print information about a topic."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """Add the topic's name and the choice of details."""
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
        """Print the type and the endpoints."""
        from ros2cli.node.graph import foreign_publishers, foreign_subscriptions
        from ros2cli.node.strategy import NodeStrategy
        from ros2topic.api import get_topic_types, unknown_topic_text

        with NodeStrategy(args) as node:
            types = get_topic_types(node, args.topic_name)
            if not types:
                return unknown_topic_text(node, args.topic_name)
            publishers = foreign_publishers(node, args.topic_name)
            subscriptions = foreign_subscriptions(node, args.topic_name)
        line_end = '\n' if args.verbose else ''
        print('Type:', types[0] if len(types) == 1 else types, end=f'\n{line_end}')
        print('Publisher count:', len(publishers), end=f'\n{line_end}')
        _print_endpoints(publishers, args.verbose)
        print('Subscription count:', len(subscriptions), end=f'\n{line_end}')
        _print_endpoints(subscriptions, args.verbose)
        return None


def _print_endpoints(endpoints: list[Any], verbose: bool) -> None:
    for endpoint in endpoints if verbose else ():
        print(endpoint, end='\n\n')
