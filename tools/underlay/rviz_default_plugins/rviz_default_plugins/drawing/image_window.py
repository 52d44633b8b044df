# SPDX-License-Identifier: Apache-2.0
"""A window of the page that shows an image."""

from __future__ import annotations

from typing import Any, ClassVar
from weakref import WeakKeyDictionary

__all__ = ['ImageWindow']

WIDTH, GAP = 320, 15


class ImageWindow:
    """
    A movable window; it opens at the bottom left, beside the windows already open.

    Parameters
    ----------
    server
        The viser server of the page.
    title
        The title of the window.
    quality
        The quality of the JPEG images sent to browsers, from 0 to 100.

    """

    _taken: ClassVar[WeakKeyDictionary[Any, set[int]]] = WeakKeyDictionary()
    """The places of open windows, by page."""

    def __init__(self, server: Any, title: str, quality: int) -> None:
        self._server = server
        self._quality = quality
        taken = self._taken.setdefault(server, set())
        self._place = next(place for place in range(len(taken) + 1) if place not in taken)
        taken.add(self._place)
        self._panel = server.gui.add_panel()
        self._tab = self._panel.add_tab(title)
        self._panel.float(x=GAP + self._place * (WIDTH + GAP), y=-GAP, width=WIDTH)
        self._image: Any = None

    def show(self, pixels: Any) -> None:
        """
        Show an image, replacing the previous one.

        Parameters
        ----------
        pixels
            Red, green and blue (height, width, 3), from 0 to 255.

        """
        if self._image is not None:
            self._image.image = pixels
            return
        with self._tab:
            self._image = self._server.gui.add_image(
                pixels, format='jpeg', jpeg_quality=self._quality
            )

    def close(self) -> None:
        """Close the window."""
        self._panel.remove()
        self._taken[self._server].discard(self._place)
