# SPDX-License-Identifier: Apache-2.0
"""What all embedded pages share: how they get into the page, and their theme."""

from __future__ import annotations

from html import escape
from importlib.resources import files
import json
from typing import Any
from urllib.parse import quote

__all__ = ['filled', 'frame_text', 'web_file']

THEME = ('theme.css', 'theme.js')
# The main page dims and blocks its widgets when its connection is lost; embedded pages have
# another connection.
STYLE = 'display: block; width: 100%; border: 0; pointer-events: auto'
# As wide as widgets of HTML: without the margins, and beyond the 95 %, of those of Markdown.
WIDE = (
    'width: calc((100% + 2 * var(--mantine-spacing-sm)) / 0.95); '
    'margin: 0 calc(-1 * var(--mantine-spacing-sm)) calc(-1 * var(--mantine-spacing-xs))'
)


def filled(text: str, settings: dict[str, Any]) -> str:
    """
    Insert the shared styles and scripts, and settings, into the HTML of an embedded page.

    Parameters
    ----------
    text
        The HTML, with comments where the parts belong, such as `/* theme.css */`.
    settings
        The value of `settings` in the scripts of the page; must be serializable as JSON.

    """
    for part in THEME:
        text = text.replace(f'/* {part} */', web_file(part))
    return text.replace('/* settings */ {}', json.dumps(settings).replace('<', '\\u003c'))


def web_file(name: str) -> str:
    """
    Read a file of this package's folder `web`.

    Parameters
    ----------
    name
        The name of the file.

    """
    return (files('rviz_common') / 'web' / name).read_text(encoding='utf-8')


def frame_text(path: str, title: str, fragment: str = '') -> str:
    """
    Build the Markdown of an embedded page that loads only once.

    HTML widgets are recreated, and thus reloaded, whenever adjacent widgets are added or removed;
    elements of Markdown widgets remain.

    Parameters
    ----------
    path
        The path of the page, such as `/drive`.
    title
        The title of the frame.
    fragment
        What the scripts of the page find in `location.hash`.

    """
    source = quote(path) + (f'#{quote(fragment)}' if fragment else '')
    frame = f'<iframe src="{escape(source)}" title="{escape(title)}" style="{STYLE}">'
    return f'<div style="{WIDE}">{frame}</iframe></div>'
