# SPDX-License-Identifier: Apache-2.0
"""Find the definition of an interface among the installed files."""

from __future__ import annotations

import os
from typing import NamedTuple

from ros2interface.api import get_interface_packages, get_interfaces, unknown_package_text
from ros2interface.api.kinds import HEADINGS
from ros2pkg.api import get_share_directory


class Definition(NamedTuple):
    """The name of an interface and the text that defines it."""

    name: str
    text: str


def read_definition(name: str) -> Definition:
    """
    Read the file that defines an interface.

    Parameters
    ----------
    name
        The name as `package/kind/Type`.

    Returns
    -------
    Definition
        The text of the .msg, .srv or .action file, or of the .idl file if there is no other.

    Raises
    ------
    RuntimeError
        There is no such interface; the message states which part of the name is wrong.

    """
    package, kind, type_name = split_name(name)
    stem = os.path.join(get_share_directory(package), kind, type_name)
    for path in (f'{stem}.{kind}', f'{stem}.idl'):
        if os.path.isfile(path):
            with open(path, encoding='utf-8') as stream:
                return Definition(name, stream.read())
    raise RuntimeError(_missing_text(name, f'{stem}.idl'))


def split_name(name: str) -> list[str]:
    """
    Split the name of an interface into package, kind and type, and check that the package exists.

    Parameters
    ----------
    name
        The name as `package/kind/Type`.

    Returns
    -------
    list of str
        The three parts; whether the package has such a type is not checked.

    Raises
    ------
    RuntimeError
        The name does not have three parts, or the package defines no interfaces.

    """
    parts = name.split('/')
    if len(parts) != 3 or not all(parts):
        raise RuntimeError(
            f"Invalid name '{name}'. Expected three parts separated by '/'{_closest(name)}"
        )
    if parts[0] not in get_interface_packages():
        raise RuntimeError(unknown_package_text(parts[0]))
    return parts


def _missing_text(name: str, path: str) -> str:
    return f"Could not find the interface '{path}'{_closest(name)}"


def _closest(name: str) -> str:
    """Return a line that suggests the interface probably meant, or ''."""
    from ros2cli.suggest import closest_name

    package, _, rest = name.partition('/')
    if not rest or rest in HEADINGS or package not in get_interface_packages():
        return ''
    known = {each.rpartition('/')[2]: each for each in get_interfaces(package, HEADINGS)}
    found = closest_name(name.rpartition('/')[2], known)
    return f'\nDid you mean {known[found]!r}?' if found else ''
