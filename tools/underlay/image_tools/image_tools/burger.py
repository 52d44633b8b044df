# SPDX-License-Identifier: Apache-2.0
"""A picture that moves: a burger that bounces off the edges of the image."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

__all__ = ['Burger']

SKY, TABLE = (70, 130, 180), (25, 30, 60)
"""The colours at the top and at the bottom of the background."""
SIZE = 0.3
"""The width of the burger, as a part of the shorter side of the image."""
SPEED = (0.45, 0.31)
"""How fast it moves, in sides of the image per second."""


class _Layer(NamedTuple):
    """A part of the burger: its upper and lower edge, its width, and its colour."""

    top: float
    bottom: float
    width: float
    colour: tuple[int, int, int]


LAYERS = (
    _Layer(0.72, 1.0, 0.92, (196, 128, 58)),
    _Layer(0.60, 0.80, 1.0, (92, 52, 30)),
    _Layer(0.54, 0.68, 0.96, (250, 190, 50)),
    _Layer(0.46, 0.60, 1.0, (96, 170, 60)),
    _Layer(0.0, 0.55, 0.92, (214, 148, 72)),
)
"""From below, in units of the width of the burger."""
SEEDS = ((-0.2, 0.18), (0.0, 0.12), (0.2, 0.18), (-0.1, 0.3), (0.12, 0.3))


@dataclass
class Burger:
    """The burger: where it is, in sides of the image, of which it covers some."""

    width: int
    """Of the image, in pixels."""
    height: int
    """Of the image, in pixels."""

    def __post_init__(self) -> None:
        shares = np.linspace(0.0, 1.0, self.height)[:, None, None]
        column = (1.0 - shares) * np.array(SKY) + shares * np.array(TABLE)
        pixels = np.broadcast_to(column, (self.height, self.width, 3)).astype(np.uint8)
        self.background = Image.fromarray(pixels)

    def draw(self, time_s: float) -> NDArray[np.uint8]:
        """
        Draw the image.

        Parameters
        ----------
        time_s
            The time since the beginning, in s.

        Returns
        -------
        numpy.ndarray
            Rows of red, green and blue.

        """
        image = self.background.copy()
        pen = ImageDraw.Draw(image)
        side = SIZE * min(self.width, self.height)
        x = (self.width - side) * _bounced(SPEED[0] * time_s)
        y = (self.height - side) * _bounced(SPEED[1] * time_s)
        for top, bottom, width, colour in LAYERS:
            margin = (1.0 - width) / 2.0 * side
            box = (x + margin, y + top * side, x + side - margin, y + bottom * side)
            pen.rounded_rectangle(box, radius=(bottom - top) / 2.0 * side, fill=colour)
        for across, down in SEEDS:
            left, top = x + (0.5 + across) * side, y + down * side
            pen.ellipse((left, top, left + 0.05 * side, top + 0.03 * side), fill=(250, 235, 200))
        return np.asarray(image)


def _bounced(way: float) -> float:
    """Return where something is between 0 and 1 that turns round at both ends."""
    return 1.0 - abs(1.0 - way % 2.0)
