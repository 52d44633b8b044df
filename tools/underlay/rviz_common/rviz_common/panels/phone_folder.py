# SPDX-License-Identifier: Apache-2.0
"""The QR code of the page, which a phone scans to open it."""

from __future__ import annotations

from html import escape
from urllib.parse import urlsplit

from rviz_common.context import Context
from rviz_common.widget_order import PHONE_ORDER

__all__ = ['PhoneFolder']

WARNING = 'Whoever scans this code can drive the robot.'
QUIET = 4
"""Width of the light margin of a QR code, in modules, as the standard demands."""
STYLE = 'display: block; width: 100%; max-width: 280px; margin: 0 auto; background: #fff'


class PhoneFolder:
    """
    A folder with the QR code of the page, if other machines can reach it.

    It includes the token: only browsers that have been admitted get it.

    Parameters
    ----------
    context
        The page.

    """

    def __init__(self, context: Context) -> None:
        self._folder = None
        url = context.page.shared_url
        if url:
            self._folder = context.gui.add_folder(
                'Open on a phone', order=PHONE_ORDER, expand_by_default=False
            )
            with self._folder:
                context.gui.add_html(_code(url))
                context.gui.add_markdown(f'In the same network, at {_place(url)}. {WARNING}')

    def close(self) -> None:
        """Remove the widgets."""
        if self._folder is not None:
            self._folder.remove()


def _place(url: str) -> str:
    """Return an address without its token."""
    return f'http://{urlsplit(url).netloc}'


def _code(url: str) -> str:
    """Draw the QR code of an address, as the HTML of an SVG."""
    from segno import make

    code = make(url, micro=False)
    label = escape(f'QR code of {_place(url)}')
    picture: str = code.svg_inline(border=QUIET, omitsize=True, svgclass=None, lineclass=None)
    return picture.replace('<svg', f'<svg role="img" aria-label="{label}" style="{STYLE}"', 1)
