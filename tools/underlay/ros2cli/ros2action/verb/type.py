# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 action type`."""

from __future__ import annotations

import argparse
from typing import Any

from ros2action.verb import VerbExtension
from ros2cli.arguments import add_strategy_arguments


class TypeVerb(VerbExtension):
    """Print an action's type."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the action's name.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        add_strategy_arguments(parser)
        parser.add_argument(
            'action_name', help="Name of the ROS action to get type (e.g. '/fibonacci')"
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print all types of an action.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        Returns
        -------
        int or str or None
            0, or 1 if the action does not exist.

        """
        from ros2action.api import get_action_names_and_types
        from ros2cli.node.strategy import NodeStrategy

        def find(graph: Any) -> list[str]:
            return dict(get_action_names_and_types(node=graph)).get(args.action_name, [])

        with NodeStrategy(args, find) as node:
            types = find(node)
        for name in types:
            print(name)
        return 0 if types else 1
