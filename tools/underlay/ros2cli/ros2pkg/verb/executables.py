# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 pkg executables`."""

from __future__ import annotations

import argparse
import os

from ros2pkg.api import get_executable_paths, get_package_names, PackageNotFoundError
from ros2pkg.api.missing import missing_package_by_name
from ros2pkg.verb import VerbExtension


class ExecutablesVerb(VerbExtension):
    """Output a list of package specific executables."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """Add the package's name and the choice of full paths."""
        parser.add_argument('package_name', nargs='?', help='The package name')
        parser.add_argument(
            '--full-path', action='store_true', help='Show the full path of each executable'
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """Print the executables of one package, or of all."""
        names = get_package_names() if args.package_name is None else [args.package_name]
        try:
            for name in names:
                _print_executables(name, args.full_path)
        except PackageNotFoundError:
            return missing_package_by_name(args.package_name)
        return None


def _print_executables(package: str, full_path: bool) -> None:
    for path in get_executable_paths(package_name=package):
        print(path if full_path else f'{package} {os.path.basename(path)}')
