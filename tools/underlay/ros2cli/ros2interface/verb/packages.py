# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 interface packages`."""

from __future__ import annotations

import argparse

from ros2interface.api import (
    add_kind_arguments,
    chosen_kinds,
    get_interface_packages,
    get_interfaces,
)
from ros2interface.verb import VerbExtension


class PackagesVerb(VerbExtension):
    """Output a list of packages that provide interfaces."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the choice of kinds.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 interface packages`; unused.

        """
        add_kind_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the packages with an interface of one of the chosen kinds.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        for package in get_interface_packages():
            if get_interfaces(package, chosen_kinds(args)):
                print(package)
        return None
