# SPDX-License-Identifier: Apache-2.0
"""Format of the output lines of a process in the log."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Optional

_PLACE = '{line}'


class LineFormat:
    """
    Format of the output lines of a process, applied to many lines at once if possible.

    Parameters
    ----------
    text
        The brace-style format, with the fields `line` and `this`.
    this
        The action, for the field `this`.

    """

    def __init__(self, text: str, this: Any) -> None:
        self._text = text
        self._this = this
        self._frame = _frame_of(text, this)

    def apply(self, lines: Sequence[str]) -> str:
        """
        Format lines for the log.

        Parameters
        ----------
        lines
            The lines, without line breaks.

        Returns
        -------
        str
            The formatted lines, with line breaks between them.

        """
        if self._frame is None:
            return '\n'.join(self._text.format(line=line, this=self._this) for line in lines)
        head, tail = self._frame
        between = f'{tail}\n{head}'
        return f'{head}{between.join(lines)}{tail}'


def _frame_of(text: str, this: Any) -> Optional[tuple[str, str]]:
    """Return the text before and after each line, None if the format is more complex."""
    head, place, tail = text.partition(_PLACE)
    if not place:
        return None
    try:
        return head.format(this=this), tail.format(this=this)
    except (KeyError, ValueError, IndexError):
        return None
