# SPDX-License-Identifier: Apache-2.0
"""The background of the scene."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from viser import ViserServer

__all__ = ['Background']


class Background:
    """
    A background of one color.

    It is an image, for which viser loads a library of 15 MB: that waits until a page is open.

    Parameters
    ----------
    server
        The server of the page.

    """

    def __init__(self, server: ViserServer) -> None:
        self._server = server
        self._color: tuple[int, int, int] | None = None
        self._painted: tuple[int, int, int] | None = None

    def choose(self, color: tuple[int, int, int]) -> None:
        """
        Set the color of the background, which the next `update` paints.

        Parameters
        ----------
        color
            Red, green and blue, each from 0 to 255.

        """
        self._color = color

    def update(self) -> None:
        """Paint the chosen colour, unless it is already painted."""
        if self._color is None or self._color == self._painted:
            return
        import numpy as np

        picture = np.full((1, 1, 3), self._color, np.uint8)
        self._server.scene.set_background_image(picture, format='png')
        self._painted = self._color
