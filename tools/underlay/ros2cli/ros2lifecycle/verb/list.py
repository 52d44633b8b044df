# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 lifecycle list`."""

from __future__ import annotations

import argparse

from ros2cli.arguments import add_hidden_nodes_argument, add_strategy_arguments
from ros2lifecycle.verb import VerbExtension


class ListVerb(VerbExtension):
    """Output a list of available transitions."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the node and the choice of transitions.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 lifecycle list`; unused.

        """
        add_strategy_arguments(parser)
        add_hidden_nodes_argument(parser)
        parser.add_argument('node_name', help='Name of the ROS node')
        parser.add_argument(
            '-a', '--all', action='store_true', help='Display all existing transitions'
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the transitions with their start and goal states.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        Raises
        ------
        RuntimeError
            The node is not a lifecycle node, or does not answer.

        """
        from ros2cli.node.direct import DirectNode
        from ros2lifecycle.api import find_lifecycle_node, get_transitions

        with DirectNode(args) as node:
            name = find_lifecycle_node(node, args.node_name)
            found = get_transitions(node, name, all_states=args.all)
        for each in found:
            print(f'- {each.transition.label} [{each.transition.id}]')
            print(f'\tStart: {each.start_state.label}')
            print(f'\tGoal: {each.goal_state.label}')
        return None
