# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 pkg executables`."""

from __future__ import annotations

import argparse
import os

from ros2pkg.api import (
    get_executable_paths,
    get_executable_paths_of_all,
    missing_package_by_name,
    PackageNotFoundError,
)
from ros2pkg.verb import VerbExtension


class ExecutablesVerb(VerbExtension):
    """Output a list of package specific executables."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the name of the package and the option for full paths.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 pkg executables`; unused.

        """
        parser.add_argument('package_name', nargs='?', help='The package name')
        parser.add_argument(
            '--full-path', action='store_true', help='Show the full path of each executable'
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the executables of one package, or of all.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        Returns
        -------
        str or None
            The error message if there is no such package.

        """
        name = args.package_name
        try:
            found = {name: get_executable_paths(package_name=name)} if name is not None else None
        except PackageNotFoundError:
            return missing_package_by_name(name)
        for package, paths in (found or get_executable_paths_of_all()).items():
            for path in paths:
                print(path if args.full_path else f'{package} {os.path.basename(path)}')
        return None
