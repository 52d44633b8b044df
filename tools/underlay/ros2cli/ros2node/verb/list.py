# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 node list`."""

from __future__ import annotations

import argparse
import sys

from ros2cli.node.arguments import add_strategy_arguments
from ros2node.verb import VerbExtension


class ListVerb(VerbExtension):
    """Output a list of available nodes."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """Add the choice of nodes and of a mere count."""
        add_strategy_arguments(parser)
        parser.add_argument(
            '-a', '--all', action='store_true', help='Display all nodes even hidden ones'
        )
        parser.add_argument(
            '-c',
            '--count-nodes',
            action='store_true',
            help='Only display the number of nodes discovered',
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """Print one full name a line, or the count."""
        from ros2cli.node.strategy import NodeStrategy
        from ros2node.api import get_node_names, shared_names

        with NodeStrategy(args) as node:
            names = get_node_names(node=node, include_hidden_nodes=args.all)
        if args.count_nodes:
            print(len(names))
            return None
        _warn_about(shared_names(names))
        for name in names:
            print(name.full_name)
        return None


def _warn_about(shared: list[str]) -> None:
    if shared:
        print(
            'WARNING: Be aware that there are nodes in the graph that share an exact name, '
            f'which can have unintended side effects: {", ".join(shared)}',
            file=sys.stderr,
        )
