# SPDX-License-Identifier: Apache-2.0
"""Small pages inside of the page, with connections of their own."""

from __future__ import annotations

from html import escape
from importlib.resources import files
import json
from typing import Any, Protocol
from urllib.parse import quote

from rviz_common.context import Context
from rviz_common.page import Route
from websockets.asyncio.server import ServerConnection

__all__ = ['SmallPage', 'Talks', 'page_text']

COMMON = ('common.css', 'link.js', 'live.css', 'live.js')
# The page dims and blocks its widgets when its own connection is lost; these have another one.
STYLE = 'display: block; width: 100%; border: 0; color-scheme: dark; pointer-events: auto'
# As wide as widgets of HTML: without the margins, and beyond the 95 %, of those of Markdown.
WIDE = (
    'width: calc((100% + 2 * var(--mantine-spacing-sm)) / 0.95); '
    'margin: 0 calc(-1 * var(--mantine-spacing-sm)) calc(-1 * var(--mantine-spacing-xs))'
)


class Talks(Protocol):
    """What talks to those who have a small page open."""

    async def talk(self, connection: ServerConnection) -> None:
        """Talk to one of them, in the thread of the page."""

    def end(self) -> None:
        """End all talks, from another thread."""


class SmallPage:
    """The page of a robot, among the widgets and at a path of its own."""

    def __init__(
        self,
        context: Context,
        name: str,
        namespace: str,
        settings: dict[str, Any],
        connections: Talks,
        order: float | None = None,
        package: str = 'robot_console',
    ) -> None:
        """Add it, or raise ValueError if there is one already."""
        self._context = context
        self._connections = connections
        self._path = f'/{name}/{namespace}' if namespace else f'/{name}'
        try:
            context.page.routes.add(
                self._path, Route(page_text(name, settings, package), connections.talk)
            )
        except ValueError:
            raise ValueError(
                'There is such a panel for this robot already. Remove one of both from the file, '
                "or give it another 'Namespace'."
            ) from None
        self._frame = context.gui.add_markdown(_frame_text(self._path, name), order=order)

    def close(self) -> None:
        """End what it does, and remove it."""
        self._context.page.routes.remove(self._path)
        self._connections.end()
        self._frame.remove()


def page_text(name: str, settings: dict[str, Any], package: str = 'robot_console') -> str:
    """Return the text of a page, with what all have in common and its settings put in."""
    folder = files('robot_console') / 'web'
    text = (files(package) / 'web' / f'{name}.html').read_text(encoding='utf-8')
    for part in COMMON:
        text = text.replace(f'/* {part} */', (folder / part).read_text(encoding='utf-8'))
    return text.replace('/* settings */ {}', json.dumps(settings).replace('<', '\\u003c'))


def _frame_text(path: str, title: str) -> str:
    """
    Return the Markdown of a small page, which loads once.

    What is added as HTML is made anew, and so loads again, whenever widgets come or go beside
    it; elements of Markdown stay.
    """
    frame = f'<iframe src="{escape(quote(path))}" title="{escape(title)}" style="{STYLE}">'
    return f'<div style="{WIDE}">{frame}</iframe></div>'
