# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 lifecycle get`."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from ros2cli.arguments import add_hidden_nodes_argument, add_strategy_arguments
from ros2lifecycle.verb import VerbExtension

ANSWER_TIMEOUT_S = 5.0


class GetVerb(VerbExtension):
    """Get lifecycle state for one or more nodes."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the node and the choice of hidden nodes.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 lifecycle get`; unused.

        """
        add_strategy_arguments(parser)
        add_hidden_nodes_argument(parser)
        parser.add_argument('node_name', nargs='?', help='Name of the ROS node')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the state of one lifecycle node, or of all with their names.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        Raises
        ------
        RuntimeError
            The given node is not a lifecycle node, or does not answer.

        """
        from ros2cli.node.direct import DirectNode
        from ros2lifecycle.api import (
            find_lifecycle_node,
            get_lifecycle_nodes,
            get_state,
            state_text,
        )

        with DirectNode(args) as node:
            if args.node_name is None:
                names = get_lifecycle_nodes(
                    node.graph, include_hidden_nodes=args.include_hidden_nodes
                )
                _print_all(node, names)
            else:
                name = find_lifecycle_node(node, args.node_name)
                print(state_text(get_state(node, name)))
        return None


def _print_all(node: Any, names: list[str]) -> None:
    from ros2lifecycle.api import get_state, state_text

    for name in names:
        try:
            print(f'{name}: {state_text(get_state(node, name, ANSWER_TIMEOUT_S))}')
        except RuntimeError as error:
            print(f"Could not get the state of '{name}': {error}", file=sys.stderr)
