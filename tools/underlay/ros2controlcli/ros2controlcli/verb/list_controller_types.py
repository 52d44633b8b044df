# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 control list_controller_types`."""

from __future__ import annotations

import argparse

from ros2controlcli.manager import add_manager_arguments, connected
from ros2controlcli.verb import VerbExtension


class ListControllerTypesVerb(VerbExtension):
    """List controller types and their base classes."""

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
        Print each controller type with its base class.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed command line.

        """
        with connected(args) as manager:
            answer = manager.ask('list_controller_types')
        width = max(map(len, answer.types), default=0)
        for kind, base_class in zip(answer.types, answer.base_classes):
            print(f'{kind:<{width}} {base_class}')
        return None
