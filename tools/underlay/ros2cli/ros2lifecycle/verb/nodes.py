# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 lifecycle nodes`."""

from __future__ import annotations

import argparse

from ros2cli.arguments import add_all_nodes_argument, add_count_argument, add_strategy_arguments
from ros2cli.names import print_names
from ros2lifecycle.verb import VerbExtension


class NodesVerb(VerbExtension):
    """Output a list of nodes with lifecycle."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the options for hidden nodes and for printing only a count.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 lifecycle nodes`; unused.

        """
        add_strategy_arguments(parser)
        add_all_nodes_argument(parser)
        add_count_argument(parser, 'nodes')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the full names of the lifecycle nodes, one per line, or only their number.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2cli.node.strategy import NodeStrategy
        from ros2lifecycle.api import get_lifecycle_nodes

        with NodeStrategy(args) as node:
            names = get_lifecycle_nodes(node, include_hidden_nodes=args.all)
        print_names(names, only_count=args.count_nodes)
        return None
