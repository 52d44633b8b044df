# SPDX-License-Identifier: Apache-2.0
"""Small pages inside of the page, with a connection of their own."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from html import escape
from importlib.resources import files
import json
from typing import Any
from urllib.parse import quote

from rviz_common.context import Context
from rviz_common.page import Route
from websockets.asyncio.server import ServerConnection

__all__ = ['add_small_page', 'small_page']

COMMON = ('common.css', 'link.js')
STYLE = 'display: block; width: 100%; border: 0; color-scheme: dark'


def add_small_page(
    context: Context,
    name: str,
    namespace: str,
    settings: dict[str, Any],
    connect: Callable[[ServerConnection], Awaitable[None]],
    height_px: int,
) -> None:
    """Add the page of a robot to the widgets; the page itself corrects its height."""
    path = f'/{name}/{namespace}' if namespace else f'/{name}'
    context.page.routes.add(path, Route(small_page(name, settings), connect))
    context.gui.add_html(
        f'<iframe src="{escape(quote(path))}" title="{escape(name)}" '
        f'style="{STYLE}; height: {height_px}px"></iframe>'
    )


def small_page(name: str, settings: dict[str, Any]) -> str:
    """Return the text of a page, with what all have in common and its settings put in."""
    folder = files('robot_console') / 'web'
    text = (folder / f'{name}.html').read_text(encoding='utf-8')
    for part in COMMON:
        text = text.replace(f'/* {part} */', (folder / part).read_text(encoding='utf-8'))
    return text.replace('/* settings */ {}', json.dumps(settings).replace('<', '\\u003c'))
