# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 interface list`."""

from __future__ import annotations

import argparse

from ros2interface.api import (
    add_kind_arguments,
    chosen_kinds,
    get_interface_packages,
    get_interfaces,
    HEADINGS,
)
from ros2interface.verb import VerbExtension


class ListVerb(VerbExtension):
    """List all interface types available."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the choice of kinds.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 interface list`; unused.

        """
        add_kind_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the interfaces of all packages under a heading for each kind.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        packages = get_interface_packages()
        for kind in chosen_kinds(args):
            print(f'{HEADINGS[kind]}:')
            for package in packages:
                for name in get_interfaces(package, [kind]):
                    print(f'    {name}')
        return None
