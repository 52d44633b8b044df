# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 action list`."""

from __future__ import annotations

import argparse

from ros2action.verb import VerbExtension
from ros2cli.arguments import add_count_argument, add_strategy_arguments, add_types_argument
from ros2cli.names import print_names, with_types


class ListVerb(VerbExtension):
    """Output a list of action names."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the options for what to show of each action.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        add_strategy_arguments(parser)
        add_types_argument(parser, 'action')
        add_count_argument(parser, 'actions')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the names of the actions, or their count.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        """
        from ros2action.api import get_action_names_and_types
        from ros2cli.node.strategy import NodeStrategy

        with NodeStrategy(args) as node:
            actions = get_action_names_and_types(node=node)
        lines = with_types(actions, show_types=args.show_types)
        print_names(lines, only_count=args.count_actions)
        return None
