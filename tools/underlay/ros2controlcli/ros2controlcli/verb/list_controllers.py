# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 control list_controllers`."""

from __future__ import annotations

import argparse
from typing import Any

from ros2controlcli.manager import add_manager_arguments, connected, print_lines
from ros2controlcli.verb import VerbExtension

PARTS = {
    'claimed_interfaces': "List controller's claimed interfaces",
    'required_state_interfaces': "List controller's required state interfaces",
    'required_command_interfaces': "List controller's required command interfaces",
    'chained_interfaces': 'List interfaces that the controllers are chained to',
    'reference_interfaces': "List controller's exported references",
}
"""What can be listed of each controller."""


class ListControllersVerb(VerbExtension):
    """List controllers, their types and states."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the options for the details of each controller, and for the controller manager.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The name of the program, which is not used.

        """
        for part, text in PARTS.items():
            parser.add_argument(f'--{part.replace("_", "-")}', action='store_true', help=text)
        parser.add_argument(
            '-v', '--verbose', action='store_true', help='List all of these for each controller'
        )
        add_manager_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print each controller with its type and state, and the requested details below it.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed command line.

        """
        with connected(args) as manager:
            controllers = manager.ask('list_controllers').controller
        if not controllers:
            print('No controllers are currently loaded!')
        name_width = max((len(each.name) for each in controllers), default=0)
        type_width = max((len(each.type) for each in controllers), default=0)
        for each in controllers:
            print(f'{each.name:<{name_width}} {each.type:<{type_width}}  {each.state}')
            for part in PARTS:
                if args.verbose or getattr(args, part):
                    print_lines(f'{part.replace("_", " ")}:', _lines(each, part), '\t')
        return None


def _lines(controller: Any, part: str) -> list[str]:
    """Return the interfaces of one kind, as the manager reports them for a controller."""
    if part != 'chained_interfaces':
        return list(getattr(controller, part))
    return [
        f'{chain.name}/{interface}'
        for chain in controller.chain_connections
        for interface in chain.reference_interfaces
    ]
