# SPDX-License-Identifier: Apache-2.0
"""All commands and verbs of `ros2`: its own, and those of other packages."""

from __future__ import annotations

from collections.abc import Mapping

from ros2cli.command_table import COMMAND_GROUP, COMMANDS
from ros2cli.entry import Entry
from ros2cli.entry_points import entries_of_group

Table = Mapping[str, Entry]


def extension_points() -> dict[str, Table]:
    """Return the groups of entry points that are searched, sorted, with their own entries."""
    groups: dict[str, Table] = {COMMAND_GROUP: COMMANDS}
    for entry in COMMANDS.values():
        groups.update(entry.create().extension_points())
    return dict(sorted(groups.items()))


def extensions(group: str, own: Table) -> dict[str, Entry]:
    """
    Return the extensions of a group of entry points, sorted by name.

    Parameters
    ----------
    group
        The name of the group.
    own
        The entries of the static table, which override entry points of the same name.

    """
    return dict(sorted({**entries_of_group(group), **own}.items()))


def why_not(entry: Entry) -> str:
    """
    Check whether an extension can be imported and created; return the reason if not, or ''.

    Parameters
    ----------
    entry
        The extension.

    """
    try:
        entry.create()
    except Exception as error:
        return f'{type(error).__name__}: {error}'
    return ''
