# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 topic type`."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.arguments import add_strategy_arguments
from ros2topic.verb import VerbExtension


class TypeVerb(VerbExtension):
    """Print a topic's type."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the name of the topic.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 topic type`; unused.

        """
        add_strategy_arguments(parser)
        parser.add_argument(
            'topic_name', help="Name of the ROS topic to get type (e.g. '/chatter')"
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print all types of the topic, one per line.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        Returns
        -------
        int
            The exit status: 1 if the topic is unknown.

        """
        from ros2cli.node.strategy import NodeStrategy
        from ros2topic.api import get_topic_types

        def find(graph: Any) -> list[str]:
            return get_topic_types(graph, args.topic_name)

        with NodeStrategy(args, find) as node:
            types = find(node)
        for name in types:
            print(name)
        return 0 if types else 1
