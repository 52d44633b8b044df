# SPDX-License-Identifier: Apache-2.0
"""What the turtles have drawn: an image of it, and the lines that are new."""

from __future__ import annotations

from dataclasses import dataclass
from io import BytesIO
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

__all__ = ['FIELD', 'SIDE_PX', 'Canvas', 'Colour', 'Line', 'Pen', 'Point']

Colour = tuple[int, int, int]
"""Red, green and blue, each from 0 to 255."""
Point = tuple[float, float]
Floats = NDArray[np.floating[Any]]

FIELD = 499.0 / 45.0
"""The side of the square field: the window of turtlesim has 500 pixels, 45 to a unit of length."""
PX_OF_PEN = 2
"""Pixels of the image for one of that window, which the width of a pen is measured in."""
PX_PER_UNIT = 45 * PX_OF_PEN
SIDE_PX = round(FIELD * PX_PER_UNIT)
PIECE_PX = 48.0
"""Longer lines are drawn in pieces: the time for one grows with the square of its length."""


@dataclass(frozen=True)
class Pen:
    """The pen of a turtle; its width is in pixels of the window of turtlesim."""

    colour: Colour = (179, 184, 255)
    width: int = 3
    is_off: bool = False

    @property
    def width_px(self) -> int:
        """The width in pixels of the image; a pen of width 0 draws the thinnest line."""
        return max(self.width, 1) * PX_OF_PEN


@dataclass
class Line:
    """A line of one pen through some points, in pixels of the image."""

    pen: Pen
    points: list[Point]


class Canvas:
    """
    The image that the turtles draw on, transparent where nothing is drawn.

    Attributes
    ----------
    is_blank
        Whether nothing is drawn.

    """

    def __init__(self) -> None:
        self.is_blank = True
        self._image = np.zeros((SIDE_PX, SIDE_PX, 4), np.uint8)
        self._new: list[Line] = []
        self._newest: dict[int, Line] = {}
        self._was_cleared = False

    def clear(self) -> None:
        """Erase everything."""
        self.is_blank = True
        self._image[:] = 0
        self.take_changes()
        self._was_cleared = True

    def draw(self, who: int, pen: Pen, start: Point, end: Point) -> None:
        """
        Draw a straight line with round ends.

        Parameters
        ----------
        who
            The number of the turtle: its lines are joined where one goes on from the last.
        pen
            The pen of the turtle, which is not off.
        start, end
            The ends of the line in the field.

        """
        self.is_blank = False
        first, last = _in_pixels(start), _in_pixels(end)
        line = self._newest.get(who)
        if line is None or line.pen != pen or line.points[-1] != first:
            line = self._newest[who] = Line(pen, [first])
            self._new.append(line)
        line.points.append(last)
        pieces = max(1, math.ceil(math.dist(first, last) / PIECE_PX))
        ways = [index / pieces for index in range(pieces + 1)]
        corners = [
            (first[0] + way * (last[0] - first[0]), first[1] + way * (last[1] - first[1]))
            for way in ways
        ]
        for one, other in zip(corners, corners[1:]):
            self._paint(pen, one, other)

    def take_changes(self) -> tuple[bool, list[Line]]:
        """Return whether it was cleared since the last call, and the lines drawn after that."""
        changes = self._was_cleared, self._new
        self._was_cleared, self._new, self._newest = False, [], {}
        return changes

    def colour_at(self, place: Point, background: Colour) -> Colour:
        """
        Return the colour at a place.

        Parameters
        ----------
        place
            The place in the field.
        background
            The colour where nothing is drawn.

        """
        x, y = (min(max(int(each), 0), SIDE_PX - 1) for each in _in_pixels(place))
        *drawn, opacity = (int(each) for each in self._image[y, x])
        red, green, blue = (
            round((opacity * over + (255 - opacity) * under) / 255)
            for over, under in zip(drawn, background)
        )
        return red, green, blue

    def png(self) -> bytes:
        """Return the image as a file."""
        file = BytesIO()
        Image.fromarray(self._image).save(file, 'png', compress_level=1)
        return file.getvalue()

    def _paint(self, pen: Pen, start: Point, end: Point) -> None:
        """Paint a short line; edges are smooth."""
        radius = pen.width_px / 2.0
        margin = radius + 1.0
        (left, top), (right, bottom) = np.sort(np.array([start, end]), axis=0)
        columns = slice(max(int(left - margin), 0), max(math.ceil(right + margin), 0))
        rows = slice(max(int(top - margin), 0), max(math.ceil(bottom + margin), 0))
        part = self._image[rows, columns]
        height, width = part.shape[:2]
        x = np.arange(columns.start, columns.start + width, dtype=np.float32) + 0.5 - start[0]
        y = np.arange(rows.start, rows.start + height, dtype=np.float32) + 0.5 - start[1]
        distance_2 = _squared_distance(x, y[:, None], end[0] - start[0], end[1] - start[1])
        is_inside = distance_2 <= (radius - 0.5) ** 2
        is_edge = (distance_2 < (radius + 0.5) ** 2) & ~is_inside
        part[is_inside] = (*pen.colour, 255)
        cover = radius + 0.5 - np.sqrt(distance_2[is_edge])
        part[is_edge] = _blended(pen.colour, cover, part[is_edge])


def _in_pixels(place: Point) -> Point:
    """Return where a place of the field is in the image, whose first row is at the top."""
    return place[0] * PX_PER_UNIT, (FIELD - place[1]) * PX_PER_UNIT


def _squared_distance(x: Floats, y: Floats, to_x: float, to_y: float) -> Floats:
    """Return how far points are from the line between the origin and another point, squared."""
    length_2 = to_x**2 + to_y**2
    way = np.clip((x * to_x + y * to_y) / length_2, 0.0, 1.0) if length_2 else np.float32(0.0)
    distance_2: Floats = (x - way * to_x) ** 2 + (y - way * to_y) ** 2
    return distance_2


def _blended(colour: Colour, cover: Floats, below: NDArray[np.uint8]) -> Floats:
    """Return pixels (number, 4) that a colour covers in part."""
    opacity = cover + below[:, 3] / 255.0 * (1.0 - cover)
    share = (cover / opacity)[:, None]
    colours = np.array(colour) * share + below[:, :3] * (1.0 - share)
    pixels: Floats = np.rint(np.column_stack([colours, opacity * 255.0]))
    return pixels
