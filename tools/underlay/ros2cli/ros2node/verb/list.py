# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 node list`."""

from __future__ import annotations

import argparse
import sys

from ros2cli.arguments import add_all_nodes_argument, add_count_argument, add_strategy_arguments
from ros2cli.names import print_names
from ros2node.verb import VerbExtension


class ListVerb(VerbExtension):
    """Output a list of available nodes."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the options for hidden nodes and for printing only a count.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 node list`; unused.

        """
        add_strategy_arguments(parser)
        add_all_nodes_argument(parser)
        add_count_argument(parser, 'nodes')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the full names of the nodes, one per line, or their number.

        A warning on stderr lists names that are shared by several nodes.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2cli.node.strategy import NodeStrategy
        from ros2node.api import get_node_names, shared_names

        with NodeStrategy(args) as node:
            names = get_node_names(node=node, include_hidden_nodes=args.all)
        if not args.count_nodes:
            _warn_about(shared_names(names))
        print_names([name.full_name for name in names], only_count=args.count_nodes)
        return None


def _warn_about(shared: list[str]) -> None:
    if shared:
        print(
            'WARNING: Be aware that there are nodes in the graph that share an exact name, '
            f'which can have unintended side effects: {", ".join(shared)}',
            file=sys.stderr,
        )
