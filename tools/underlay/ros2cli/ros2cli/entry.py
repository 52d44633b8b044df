# SPDX-License-Identifier: Apache-2.0
"""One row of the static tables of commands and verbs."""

from __future__ import annotations

TYPE_CHECKING = False

if TYPE_CHECKING:
    from typing import Any  # noqa: I300


class Entry:
    """
    A row of the static tables of commands and verbs, which does not import the class it names.

    Parameters
    ----------
    target
        Where the class of the command or verb is, as `module:Class`.
    summary
        What it does, for the help.
    hidden
        Whether the help leaves it out.

    """

    __slots__ = ('hidden', 'summary', 'target')

    def __init__(self, target: str, summary: str, hidden: bool = False) -> None:
        self.target = target
        self.summary = summary
        self.hidden = hidden

    def create(self) -> Any:
        """Import the class which `module:Class` names and return an instance of it."""
        module, _, name = self.target.partition(':')
        return getattr(__import__(module, fromlist=[name]), name)()
