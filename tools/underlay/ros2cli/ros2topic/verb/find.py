# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 topic find`."""

from __future__ import annotations

import argparse

from ros2cli.node.arguments import add_strategy_arguments
from ros2topic.verb import VerbExtension


class FindVerb(VerbExtension):
    """Output a list of available topics of a given type."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """Add the type and the choice of a mere count."""
        add_strategy_arguments(parser)
        parser.add_argument(
            'topic_type',
            help="Name of the ROS topic type to filter for (e.g. 'std_msgs/msg/String')",
        )
        parser.add_argument(
            '-c',
            '--count-topics',
            action='store_true',
            help='Only display the number of topics discovered',
        )
        parser.add_argument(
            '--include-hidden-topics',
            action='store_true',
            default=argparse.SUPPRESS,
            help='Consider hidden topics as well',
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """Print the topics of the type, or their number."""
        from ros2cli.node.strategy import NodeStrategy
        from ros2topic.api import get_topic_names_and_types

        with NodeStrategy(args) as node:
            topics = get_topic_names_and_types(
                node=node, include_hidden_topics=args.include_hidden_topics
            )
        names = [name for name, types in topics if args.topic_type in types]
        lines = [str(len(names))] if args.count_topics else names
        _print_lines(lines)
        return None


def _print_lines(lines: list[str]) -> None:
    for line in lines:
        print(line)
