# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 pkg prefix`."""

from __future__ import annotations

import argparse

from ros2pkg.api import (
    get_package_prefix,
    get_share_directory,
    missing_package,
    PackageNotFoundError,
)
from ros2pkg.verb import VerbExtension


class PrefixVerb(VerbExtension):
    """Output the prefix path of a package."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the name of the package and the option for its share directory.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 pkg prefix`; unused.

        """
        parser.add_argument('package_name', help='The package name')
        parser.add_argument(
            '--share', action='store_true', help='show share directory for the package'
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the install prefix or the share directory of the package.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        Returns
        -------
        str or None
            The error message if there is no such package.

        """
        find = get_share_directory if args.share else get_package_prefix
        try:
            print(find(args.package_name))
        except PackageNotFoundError:
            return missing_package(args.package_name)
        return None
