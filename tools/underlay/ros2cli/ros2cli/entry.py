# SPDX-License-Identifier: Apache-2.0
"""Commands and verbs by name: rows of static tables, and entry points of other distributions."""

from __future__ import annotations

TYPE_CHECKING = False

if TYPE_CHECKING:
    from typing import Any  # noqa: I300


class Entry:
    """
    Row of the static tables of commands and verbs; does not import the class until `create`.

    Parameters
    ----------
    target
        The class of the command or verb, as `module:Class`.
    summary
        The description for the help.
    hidden
        Whether the help omits it.

    """

    __slots__ = ('hidden', 'summary', 'target')

    def __init__(self, target: str, summary: str, hidden: bool = False) -> None:
        self.target = target
        self.summary = summary
        self.hidden = hidden

    def create(self) -> Any:
        """Import the class and return an instance."""
        module, _, name = self.target.partition(':')
        return getattr(__import__(module, fromlist=[name]), name)()


def find_entry(group: str, name: str) -> Entry | None:
    """
    Find the entry point of a command or verb in other installed distributions.

    Parameters
    ----------
    group
        The group of entry points, such as `ros2bag.verb`.
    name
        The name of the command or verb.

    Returns
    -------
    Entry or None
        Its class, without a summary; None if no distribution provides it.

    """
    return entries_of_group(group, name).get(name)


def entries_of_group(group: str, name: str | None = None) -> dict[str, Entry]:
    """
    Read the entry points of a group from all installed distributions, which is slow.

    Parameters
    ----------
    group
        The group of entry points, such as `ros2bag.verb`.
    name
        The only name to look for; None for all.

    Returns
    -------
    dict of str to Entry
        The classes by name, without summaries.

    """
    from importlib.metadata import entry_points

    found = entry_points(group=group) if name is None else entry_points(group=group, name=name)
    return {point.name: Entry(point.value, '') for point in found}
