# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 component load`."""

from __future__ import annotations

import argparse

from ros2cli.arguments import add_strategy_arguments
from ros2component.arguments import add_load_arguments
from ros2component.verb import VerbExtension


class LoadVerb(VerbExtension):
    """Load a component into a container node."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the container and what to load into it.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        add_strategy_arguments(parser)
        parser.add_argument(
            'container_node_name', help='Container node name to load component into'
        )
        add_load_arguments(parser)
        parser.add_argument(
            '-q', '--quiet', action='store_true', help='Only display the ID of the component'
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Load a component into a container, and print its unique ID and name.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        Raises
        ------
        RuntimeError
            The container does not exist, or rejects the component.

        """
        from ros2cli.node.direct import DirectNode
        from ros2component.api import find_container, load_component

        with DirectNode(args) as node:
            container = find_container(node.watch, args.container_node_name)
            component = load_component(node, container, args)
        if args.quiet:
            print(component.uid)
        else:
            print(
                f"Loaded component {component.uid} into '{container}' container node as "
                f"'{component.name}'"
            )
        return None
