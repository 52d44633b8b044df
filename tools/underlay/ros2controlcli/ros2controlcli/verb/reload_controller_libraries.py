# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 control reload_controller_libraries`."""

from __future__ import annotations

import argparse

from ros2controlcli.manager import add_manager_arguments, connected
from ros2controlcli.states import ACTIVE, see_log
from ros2controlcli.verb import VerbExtension


class ReloadControllerLibrariesVerb(VerbExtension):
    """Reload controller libraries."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the option to stop controllers.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The name of the program, which is not used.

        """
        parser.add_argument(
            '--force-kill', action='store_true', help='Force stop of loaded controllers'
        )
        add_manager_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Load the libraries of controllers anew, which unloads all controllers.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed command line.

        Returns
        -------
        int, str or None
            None if that is done, else the message that says why not.

        """
        with connected(args) as manager:
            if not manager.ask('reload_controller_libraries', args.force_kill).ok:
                active = [name for name, state in manager.states().items() if state == ACTIVE]
                advice = (
                    f'Active are: {", ".join(active)}. Deactivate them, or try --force-kill'
                    if active and not args.force_kill
                    else ''
                )
                return '. '.join(
                    filter(
                        None, ('Error reloading controller libraries', see_log(manager), advice)
                    )
                )
        print('Successfully reloaded controller libraries')
        return None
