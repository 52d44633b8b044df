# SPDX-License-Identifier: Apache-2.0
"""The installed interfaces by package and kind, from the ament index; nothing is imported."""

from __future__ import annotations

import argparse
from collections.abc import Iterable

from ament_index_python.resources import get_resource, get_resources

__all__ = [
    'HEADINGS',
    'add_kind_arguments',
    'chosen_kinds',
    'get_interface_packages',
    'get_interfaces',
    'unknown_package_text',
]

RESOURCE = 'rosidl_interfaces'
HEADINGS = {'msg': 'Messages', 'srv': 'Services', 'action': 'Actions'}


def get_interface_packages() -> list[str]:
    """Return the names of all packages with interfaces, sorted."""
    return sorted(get_resources(RESOURCE))


def get_interfaces(package: str, kinds: Iterable[str]) -> list[str]:
    """
    List the interfaces of some kinds that a package defines.

    Parameters
    ----------
    package
        The name of a package with interfaces.
    kinds
        The kinds to list: 'msg', 'srv' or 'action'.

    Returns
    -------
    list of str
        Names as `package/kind/Type`, sorted.

    Raises
    ------
    LookupError
        The package is not installed, or defines no interfaces.

    """
    wanted = set(kinds)
    files, _ = get_resource(RESOURCE, package)
    names = {line.rpartition('.')[0] for line in files.splitlines() if line}
    return sorted(f'{package}/{name}' for name in names if name.partition('/')[0] in wanted)


def unknown_package_text(package: str) -> str:
    """
    Format the error message for a package without interfaces.

    Parameters
    ----------
    package
        The name as it was given.

    Returns
    -------
    str
        The message, with the closest name or the cause in a further line if known.

    """
    from ros_environment.suggestions import did_you_mean

    hint = did_you_mean(package, get_interface_packages()) or _cause(package)
    return '\n'.join([f"Unknown package '{package}'", hint]).rstrip()


def _cause(package: str) -> str:
    from ament_index_python.packages import get_packages_with_prefixes
    from ros_environment.workspace import explain_missing_package

    if package in get_packages_with_prefixes():
        return f"The package '{package}' is installed, but defines no interfaces."
    return explain_missing_package(package)


def add_kind_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add an option for each kind of interface.

    Parameters
    ----------
    parser
        The parser of a verb.

    """
    add = parser.add_argument
    add('-m', '--only-msgs', action='store_true', help='Only consider the message types')
    add('-s', '--only-srvs', action='store_true', help='Only consider the service types')
    add('-a', '--only-actions', action='store_true', help='Only consider the action types')


def chosen_kinds(args: argparse.Namespace) -> list[str]:
    """
    List the kinds of interface that the options choose.

    Parameters
    ----------
    args : argparse.Namespace
        The parsed arguments with the options of `add_kind_arguments`.

    Returns
    -------
    list of str
        Some of 'msg', 'srv' and 'action', in this order; all if none is chosen.

    """
    wanted = {'msg': args.only_msgs, 'srv': args.only_srvs, 'action': args.only_actions}
    return [kind for kind in HEADINGS if wanted[kind]] or list(HEADINGS)
