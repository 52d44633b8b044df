# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 control set_controller_state`."""

from __future__ import annotations

import argparse

from ros2controlcli.manager import add_manager_arguments, connected
from ros2controlcli.states import ACTIVE, bring, INACTIVE
from ros2controlcli.verb import VerbExtension


class SetControllerStateVerb(VerbExtension):
    """Adjust the state of a controller."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the controller and the state.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The name of the program, which is not used.

        """
        parser.add_argument('controller_name', help='Name of the controller to be changed')
        parser.add_argument(
            'state', choices=(INACTIVE, ACTIVE), help='State in which the controller should be'
        )
        add_manager_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Configure, activate or deactivate a controller, whatever its state needs.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed command line.

        Returns
        -------
        int, str or None
            None if the controller is in the state, else the message that says why not.

        """
        with connected(args) as manager:
            return bring(manager, args.controller_name, args.state) or None
