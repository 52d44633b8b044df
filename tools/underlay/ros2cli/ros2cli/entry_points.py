# SPDX-License-Identifier: Apache-2.0
"""Commands and verbs that other installed distributions offer as entry points."""

from __future__ import annotations

from ros2cli.entry import Entry


def find_entry(group: str, name: str) -> Entry | None:
    """Return the entry point `name` of a group, or None if nobody offers it."""
    return entries_of_group(group, name).get(name)


def entries_of_group(group: str, name: str | None = None) -> dict[str, Entry]:
    """Return the entry points of a group by name; the scan is paid for only when called."""
    from importlib.metadata import entry_points

    found = entry_points(group=group) if name is None else entry_points(group=group, name=name)
    return {point.name: Entry(point.value, '') for point in found}
