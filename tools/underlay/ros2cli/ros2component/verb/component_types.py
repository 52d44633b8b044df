# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 component types`."""

from __future__ import annotations

import argparse

from ros2component.verb import VerbExtension

RESOURCE = 'rclcpp_components'


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
        if args.package_name is not None:
            types = _component_types(args.package_name)
            for name in types:
                print(name)
            return None if types else self._unknown_text(args.package_name)
        for package in _component_packages():
            print(package)
            for name in _component_types(package):
                print(f'  {name}')
        return None

    @staticmethod
    def _unknown_text(package: str) -> str:
        from ros2pkg.api import get_package_names, missing_package_by_name

        if package in get_package_names():
            return f"No components are registered by the package '{package}'"
        return missing_package_by_name(package)


def _component_packages() -> list[str]:
    """Return the names of all packages with components, sorted."""
    from ament_index_python.resources import get_resources

    return sorted(get_resources(RESOURCE))


def _component_types(package: str) -> list[str]:
    """Return the classes that a package registers in the ament index, in their order."""
    from ament_index_python.resources import get_resource

    try:
        content, _ = get_resource(RESOURCE, package)
    except LookupError:
        return []
    return [line.partition(';')[0] for line in content.splitlines() if line]
