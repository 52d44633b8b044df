# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 interface package`."""

from __future__ import annotations

import argparse

from ros2interface.api import (
    add_kind_arguments,
    chosen_kinds,
    get_interface_packages,
    get_interfaces,
    unknown_package_text,
)
from ros2interface.verb import VerbExtension


class PackageVerb(VerbExtension):
    """Output a list of available interface types within one package."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the package and the choice of kinds.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 interface package`; unused.

        """
        add_kind_arguments(parser)
        parser.add_argument('package_name', help="Name of the ROS package (e.g. 'std_msgs')")

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the interfaces of a package.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        Returns
        -------
        str or None
            The error message if there is no such package, or it defines no interfaces.

        """
        if args.package_name not in get_interface_packages():
            return unknown_package_text(args.package_name)
        for name in get_interfaces(args.package_name, chosen_kinds(args)):
            print(name)
        return None
