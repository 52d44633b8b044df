# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 control list_hardware_interfaces`."""

from __future__ import annotations

import argparse

from ros2controlcli.manager import add_manager_arguments, command_line, connected, print_lines
from ros2controlcli.verb import VerbExtension


class ListHardwareInterfacesVerb(VerbExtension):
    """List command and state interfaces."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the option for the controller manager.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The name of the program, which is not used.

        """
        add_manager_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print all command and state interfaces, sorted by name.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed command line.

        """
        with connected(args) as manager:
            answer = manager.ask('list_hardware_interfaces')
        print_lines('command interfaces', sorted(map(command_line, answer.command_interfaces)))
        print_lines('state interfaces', sorted(each.name for each in answer.state_interfaces))
        return None
