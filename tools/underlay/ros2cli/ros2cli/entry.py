# SPDX-License-Identifier: Apache-2.0
"""Rows of the static tables of commands and verbs."""

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
