# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 control list_hardware_interfaces`."""

from __future__ import annotations

import argparse

from ros2controlcli.manager import add_manager_arguments, ask
from ros2controlcli.printing import command_line, print_lines
from ros2controlcli.verb import VerbExtension


class ListHardwareInterfacesVerb(VerbExtension):
    """List command and state interfaces."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """Add the controller manager."""
        add_manager_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """Print the interfaces, sorted."""
        answer = ask(args, 'list_hardware_interfaces', 'ListHardwareInterfaces')
        print_lines('command interfaces', sorted(map(command_line, answer.command_interfaces)))
        print_lines('state interfaces', sorted(each.name for each in answer.state_interfaces))
        return None
