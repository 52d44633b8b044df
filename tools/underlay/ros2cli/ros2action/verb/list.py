# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 action list`."""

from __future__ import annotations

import argparse

from ros2action.verb import VerbExtension
from ros2cli.node.arguments import add_strategy_arguments


class ListVerb(VerbExtension):
    """Output a list of action names."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """Add what to show of each action."""
        add_strategy_arguments(parser)
        parser.add_argument(
            '-t', '--show-types', action='store_true', help='Additionally show the action type'
        )
        parser.add_argument(
            '-c',
            '--count-actions',
            action='store_true',
            help='Only display the number of actions discovered',
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """Print the actions, or their count."""
        from ros2action.api import get_action_names_and_types
        from ros2cli.node.strategy import NodeStrategy

        with NodeStrategy(args) as node:
            actions = get_action_names_and_types(node=node)
        if args.count_actions:
            print(len(actions))
            return None
        for name, types in actions:
            print(f'{name} [{", ".join(types)}]' if args.show_types else name)
        return None
