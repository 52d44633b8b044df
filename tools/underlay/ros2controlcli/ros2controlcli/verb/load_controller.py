# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 control load_controller`."""

from __future__ import annotations

import argparse
import os

from ros2controlcli.manager import add_manager_arguments, connected, Manager
from ros2controlcli.states import ACTIVE, bring, INACTIVE, see_log
from ros2controlcli.verb import VerbExtension


class LoadControllerVerb(VerbExtension):
    """Load a controller in a controller manager."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the controller, its parameter file and the state that it is brought to.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The name of the program, which is not used.

        """
        parser.add_argument('controller_name', help='Name of the controller')
        parser.add_argument(
            'param_file',
            nargs='?',
            help='YAML file with the parameters of the controller, among them its type',
        )
        parser.add_argument(
            '--set-state',
            choices=(INACTIVE, ACTIVE),
            help='State to which the controller is brought once it is loaded',
        )
        add_manager_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Tell the manager the parameters of a controller, load it, and bring it to a state.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed command line.

        Returns
        -------
        int, str or None
            None if that is done, else the message that says why not.

        """
        name = args.controller_name
        with connected(args) as manager:
            states = manager.states()
            if name in states:
                return (
                    f"The controller '{name}' is loaded already, and {states[name]}. To change "
                    f'that: ros2 control set_controller_state {name} {args.set_state or ACTIVE}'
                )
            if args.param_file and not manager.set_parameters(
                name, os.path.abspath(args.param_file)
            ):
                return f"The controller '{name}' is not loaded: the parameters are refused"
            if not manager.ask('load_controller', name).ok:
                return _refusal(manager, name)
            print(f'Successfully loaded controller {name}')
            return (bring(manager, name, args.set_state) or None) if args.set_state else None


def _refusal(manager: Manager, name: str) -> str:
    """Build the message about a controller that the manager has not loaded."""
    types = sorted(set(manager.ask('list_controller_types').types))
    return (
        f"Error loading controller '{name}'. {see_log(manager)}. It has to know the type from its "
        f"parameter '{name}.type', which a parameter file can set. Types that it can load: "
        f'{", ".join(types) or "none"}'
    )
