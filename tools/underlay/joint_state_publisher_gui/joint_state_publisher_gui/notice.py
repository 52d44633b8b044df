# SPDX-License-Identifier: Apache-2.0
"""Messages on the page."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from viser import GuiApi

__all__ = ['Notice']

MOST_LINES = 6
LONGEST_LINE = 400
STYLE = 'padding:0.1em 0.8em 0.6em; font-size:0.85em; line-height:1.35; overflow-wrap:anywhere'


class Notice:
    """
    A text area on the page for messages, which may contain arbitrary names.

    Parameters
    ----------
    gui
        Where the widget is added, at the current position; the message is empty at first.

    """

    def __init__(self, gui: GuiApi) -> None:
        self._html = gui.add_html('')

    @property
    def content(self) -> str:
        """Return the messages as HTML."""
        return str(self._html.content)

    def say(self, *sentences: str) -> None:
        """
        Show messages in place of earlier ones, escaped for HTML.

        Parameters
        ----------
        *sentences
            The messages, one per line; at most 6 are shown, each truncated to 400 characters.
            Without messages, the area is cleared.

        """
        lines = [line[:LONGEST_LINE] for line in sentences]
        if len(lines) > MOST_LINES:
            lines[MOST_LINES:] = [f'And {len(lines) - MOST_LINES} more like this.']
        text = '<br>'.join(map(escape, lines))
        content = f'<div style="{STYLE}">{text}</div>' if lines else ''
        if self._html.content != content:
            self._html.content = content
