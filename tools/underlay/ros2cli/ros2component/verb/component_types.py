# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 component types`."""

from __future__ import annotations

import argparse

from ros2component.verb import VerbExtension


class TypesVerb(VerbExtension):
    """Output a list of components registered in the ament index."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the package, which is optional.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        parser.add_argument(
            'package_name', nargs='?', help='Package name to list component types from'
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the components of one package, or those of all packages below the package names.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        Returns
        -------
        int or str or None
            An error message if the named package registers no component.

        """
        from ros2component.api.index import get_component_packages, get_component_types

        if args.package_name is not None:
            types = get_component_types(args.package_name)
            for name in types:
                print(name)
            return None if types else self._unknown_text(args.package_name)
        for package in get_component_packages():
            print(package)
            for name in get_component_types(package):
                print(f'  {name}')
        return None

    @staticmethod
    def _unknown_text(package: str) -> str:
        from ros2pkg.api import get_package_names
        from ros2pkg.api.missing import missing_package_by_name

        if package in get_package_names():
            return f"No components are registered by the package '{package}'"
        return missing_package_by_name(package)
