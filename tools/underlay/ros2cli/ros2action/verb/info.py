# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 action info`."""

from __future__ import annotations

import argparse
from typing import Any

from ros2action.verb import VerbExtension
from ros2cli.arguments import add_strategy_arguments


class InfoVerb(VerbExtension):
    """Print information about an action."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the action's name and the options for what to show of its nodes.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        add_strategy_arguments(parser)
        parser.add_argument(
            'action_name', help="Name of the ROS action to get info (e.g. '/fibonacci')"
        )
        parser.add_argument(
            '-t', '--show-types', action='store_true', help='Additionally show the action type'
        )
        parser.add_argument(
            '-c',
            '--count',
            action='store_true',
            help='Only display the number of action clients and action servers',
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the clients and servers of an action; an unknown action has none.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        """
        from ros2action.api import get_action_clients, get_action_servers
        from ros2cli.node.strategy import NodeStrategy

        def find(graph: Any) -> list[Any]:
            return get_action_servers(graph, args.action_name)

        with NodeStrategy(args, find) as node:
            clients = get_action_clients(node, args.action_name)
            servers = get_action_servers(node, args.action_name)
        print(f'Action: {args.action_name}')
        _print_nodes('Action clients', clients, args)
        _print_nodes('Action servers', servers, args)
        return None


def _print_nodes(title: str, nodes: list[Any], args: argparse.Namespace) -> None:
    print(f'{title}: {len(nodes)}')
    for name, types in () if args.count else nodes:
        print(f'    {name} [{", ".join(types)}]' if args.show_types else f'    {name}')
