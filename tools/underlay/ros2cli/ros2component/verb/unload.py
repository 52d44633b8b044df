# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 component unload`."""

from __future__ import annotations

import argparse
import sys

from ros2cli.arguments import add_strategy_arguments, whole_number
from ros2component.verb import VerbExtension


class UnloadVerb(VerbExtension):
    """Unload a component from a container node."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the container and the unique IDs of the components.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        add_strategy_arguments(parser)
        parser.add_argument(
            'container_node_name', help='Container node name to unload component from'
        )
        parser.add_argument(
            'component_uid', nargs='+', type=whole_number, help='Unique ID of the component'
        )
        parser.add_argument(
            '-q',
            '--quiet',
            action='store_true',
            help='Do not report unloaded components',
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Unload components from a container one by one, and continue if one cannot be unloaded.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        Returns
        -------
        int or str or None
            0, or 1 if the container has not unloaded all of them.

        """
        from ros2cli.node.direct import DirectNode
        from ros2component.api import find_container, unload_component

        status = 0
        with DirectNode(args) as node:
            container = find_container(node.watch, args.container_node_name)
            for uid in args.component_uid:
                reason = unload_component(node, container, uid)
                if reason:
                    status = 1
                    print(
                        f"Failed to unload component {uid} from '{container}' container node\n"
                        f'    {reason}',
                        file=sys.stderr,
                    )
                elif not args.quiet:
                    print(f"Unloaded component {uid} from '{container}' container node")
        return status
