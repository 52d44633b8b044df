# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 node info`."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.arguments import add_strategy_arguments
from ros2cli.names import closest
from ros2node.verb import VerbExtension


class InfoVerb(VerbExtension):
    """Output information about a node."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the name of the node and the option for hidden names.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 node info`; unused.

        """
        add_strategy_arguments(parser)
        parser.add_argument('node_name', help='Fully qualified node name to request information')
        parser.add_argument(
            '--include-hidden',
            action='store_true',
            help='Display hidden topics, services, and actions as well',
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print what the node publishes, subscribes to, serves and calls.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        Returns
        -------
        str or None
            The error message if there is no such node.

        """
        from ros2cli.node.strategy import NodeStrategy
        from ros2node.api import get_node_names, node_sections, NodeName

        def find(graph: Any) -> list[NodeName]:
            names = get_node_names(node=graph, include_hidden_nodes=True)
            return [name for name in names if name.full_name == args.node_name]

        with NodeStrategy(args, find) as node:
            chosen = find(node)
            if not chosen:
                names = get_node_names(node=node, include_hidden_nodes=True)
                return _unknown_node(args.node_name, [name.full_name for name in names])
            sections = node_sections(node, chosen[0], args.include_hidden)
        print(args.node_name)
        for title, infos in sections:
            print(f'  {title}:')
            print('\n'.join(f'    {info.name}: {", ".join(info.types)}' for info in infos))
        return None


def _unknown_node(name: str, known: list[str]) -> str:
    return '\n'.join([f"Unable to find node '{name}'", closest(name, known)]).rstrip()
