# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 control switch_controllers`."""

from __future__ import annotations

import argparse

from ros2cli.arguments import positive_number
from ros2controlcli.manager import add_manager_arguments, connected
from ros2controlcli.states import see_log
from ros2controlcli.verb import VerbExtension


class SwitchControllersVerb(VerbExtension):
    """Switch controllers in a controller manager."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the options that select the controllers, and how they are switched.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The name of the program, which is not used.

        """
        for verb in ('deactivate', 'activate'):
            parser.add_argument(
                f'--{verb}',
                nargs='*',
                default=[],
                metavar='CONTROLLER',
                help=f'Name of the controllers to be {verb}d',
            )
        parser.add_argument(
            '--strict', action='store_true', help='Switch all of them, or none if one fails'
        )
        parser.add_argument(
            '--activate-asap', action='store_true', help='Activate as soon as that is possible'
        )
        parser.add_argument(
            '--switch-timeout',
            type=positive_number,
            default=5.0,
            metavar='SECONDS',
            help='Timeout for switching controllers (default: %(default)s)',
        )
        add_manager_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Activate and deactivate controllers.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed command line.

        Returns
        -------
        int, str or None
            None if they were switched, else the message that says why not.

        """
        if not args.activate and not args.deactivate:
            return 'Choose controllers: --activate NAME, --deactivate NAME, or both'
        with connected(args) as manager:
            answer = manager.ask(
                'switch_controllers',
                args.deactivate,
                args.activate,
                args.strict,
                args.activate_asap,
                args.switch_timeout,
            )
            reason = answer.message or see_log(manager)
        if not answer.ok:
            return f'Error switching controllers. {reason}'
        print('Successfully switched controllers')
        if answer.message:
            print(answer.message)
        return None
