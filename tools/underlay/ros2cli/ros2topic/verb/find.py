# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 topic find`."""

from __future__ import annotations

import argparse

from ros2cli.arguments import add_count_argument, add_hidden_argument, add_strategy_arguments
from ros2cli.names import print_names
from ros2topic.verb import VerbExtension


class FindVerb(VerbExtension):
    """Output a list of available topics of a given type."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the message type and the options for hidden topics and for printing only a count.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 topic find`; unused.

        """
        add_strategy_arguments(parser)
        parser.add_argument(
            'topic_type',
            help="Name of the ROS topic type to filter for (e.g. 'std_msgs/msg/String')",
        )
        add_count_argument(parser, 'topics')
        add_hidden_argument(parser, 'topics')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the topics of the type, or their number.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2cli.node.strategy import NodeStrategy
        from ros2topic.api import get_topic_names_and_types

        with NodeStrategy(args) as node:
            topics = get_topic_names_and_types(
                node=node, include_hidden_topics=args.include_hidden_topics
            )
        names = [name for name, types in topics if args.topic_type in types]
        print_names(names, only_count=args.count_topics)
        return None
