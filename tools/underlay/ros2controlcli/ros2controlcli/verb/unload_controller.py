# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 control unload_controller`."""

from __future__ import annotations

import argparse

from ros2controlcli.manager import add_manager_arguments, connected, unknown
from ros2controlcli.states import ACTIVE, see_log
from ros2controlcli.verb import VerbExtension


class UnloadControllerVerb(VerbExtension):
    """Unload a controller in a controller manager."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the controller.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The name of the program, which is not used.

        """
        parser.add_argument('controller_name', help='Name of the controller')
        add_manager_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Unload a controller.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed command line.

        Returns
        -------
        int, str or None
            None if it is unloaded, else the message that says why not.

        """
        name = args.controller_name
        with connected(args) as manager:
            states = manager.states()
            if name not in states:
                return unknown('controller', name, states)
            if not manager.ask('unload_controller', name).ok:
                advice = (
                    f'It is active. Try first: ros2 control set_controller_state {name} inactive'
                    if states[name] == ACTIVE
                    else see_log(manager)
                )
                return f"Error unloading controller '{name}'. {advice}"
        print(f'Successfully unloaded controller {name}')
        return None
