# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 component list`."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from ros2cli.arguments import add_strategy_arguments
from ros2component.verb import VerbExtension

ANSWER_TIMEOUT_S = 5.0


class ListVerb(VerbExtension):
    """Output a list of running containers and components."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the container, which is optional, and the option to list containers only.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        add_strategy_arguments(parser)
        parser.add_argument(
            'container_node_name', nargs='?', help='Container node name to list components from'
        )
        parser.add_argument(
            '--containers-only', action='store_true', help='List found containers nodes only'
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the containers, each with its components below it.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        Raises
        ------
        RuntimeError
            The named container does not exist.

        """
        from ros2cli.node.direct import DirectNode
        from ros2component.api import find_container, get_containers

        name = args.container_node_name
        with DirectNode(args) as node:
            containers = (
                get_containers(node.graph) if name is None else [find_container(node.watch, name)]
            )
            for container in containers:
                if args.containers_only:
                    print(container)
                else:
                    _print_components(node, container)
        return None


def _print_components(node: Any, container: str) -> None:
    from ros2component.api import get_components

    try:
        components = get_components(node, container, ANSWER_TIMEOUT_S)
    except RuntimeError as error:
        print(f"Could not list the components in '{container}': {error}", file=sys.stderr)
        return
    print(container)
    for component in components:
        print(f'  {component.uid}  {component.name}')
