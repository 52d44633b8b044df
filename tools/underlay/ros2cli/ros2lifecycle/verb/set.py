# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 lifecycle set`."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.arguments import add_hidden_nodes_argument, add_strategy_arguments
from ros2lifecycle.verb import VerbExtension


class SetVerb(VerbExtension):
    """Trigger lifecycle state transition."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the node and the transition.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 lifecycle set`; unused.

        """
        add_strategy_arguments(parser)
        add_hidden_nodes_argument(parser)
        parser.add_argument('node_name', help='Name of the ROS node')
        parser.add_argument('transition', help='The lifecycle transition, by its label or number')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Trigger a transition and print whether it has succeeded.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        Returns
        -------
        str or None
            The error message if the transition is not available now, or has failed.

        Raises
        ------
        RuntimeError
            The node is not a lifecycle node, or does not answer.

        """
        from ros2cli.node.direct import DirectNode
        from ros2lifecycle.api import change_state, find_lifecycle_node, get_transitions

        with DirectNode(args) as node:
            name = find_lifecycle_node(node, args.node_name)
            available = [each.transition for each in get_transitions(node, name, all_states=False)]
            wanted = [each for each in available if args.transition in (each.label, str(each.id))]
            if not wanted:
                return _unknown_text(args.transition, available)
            succeeded = change_state(node, name, wanted[0])
        if not succeeded:
            return 'Transitioning failed'
        print('Transitioning successful')
        return None


def _unknown_text(name: str, available: list[Any]) -> str:
    from ros_environment.suggestions import did_you_mean

    lines = ['Unknown transition requested, available ones are:']
    lines += [f'- {each.label} [{each.id}]' for each in available]
    lines.append(did_you_mean(name, [each.label for each in available]))
    return '\n'.join(lines).rstrip()
