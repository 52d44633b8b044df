# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 control list_hardware_components`."""

from __future__ import annotations

import argparse

from ros2controlcli.manager import add_manager_arguments, command_line, connected, print_lines
from ros2controlcli.verb import VerbExtension


class ListHardwareComponentsVerb(VerbExtension):
    """List hardware components."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the options for state interfaces and for the controller manager.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The name of the program, which is not used.

        """
        parser.add_argument(
            '-v', '--verbose', action='store_true', help='List state interfaces as well'
        )
        add_manager_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print each hardware component with its state and its interfaces.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed command line.

        """
        with connected(args) as manager:
            components = manager.ask('list_hardware_components').component
        for number, each in enumerate(components, start=1):
            print(f'Hardware Component {number}')
            print(f'\tname: {each.name}')
            print(f'\ttype: {each.type}')
            print(f'\tplugin name: {each.plugin_name or each.class_type}')
            print(f'\tstate: id={each.state.id} label={each.state.label}')
            print(f'\tread/write rate: {each.rw_rate} Hz')
            print(f'\tis_async: {each.is_async}')
            print_lines('command interfaces', map(command_line, each.command_interfaces), '\t')
            if args.verbose:
                names = [interface.name for interface in each.state_interfaces]
                print_lines('state interfaces', names, '\t')
        return None
