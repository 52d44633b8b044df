# SPDX-License-Identifier: Apache-2.0
"""What turtles draw: colours at places, the image, and the lines that are new."""

from __future__ import annotations

from io import BytesIO

import numpy as np
from PIL import Image
import pytest
from turtlesim_py.canvas import Canvas, FIELD, Pen, SIDE_PX

BLUE, RED, GREEN = (69, 86, 255), (255, 0, 0), (0, 255, 0)
UNIT_PX = SIDE_PX / FIELD


@pytest.fixture
def canvas() -> Canvas:
    """Return an empty canvas."""
    return Canvas()


def test_a_line_has_the_width_of_its_pen(canvas: Canvas) -> None:
    """A pen of 9 pixels, 45 of which are a unit, reaches 0.1 units to each side."""
    canvas.draw(1, Pen(RED, 9), (1.0, 5.0), (9.0, 5.0))
    for x in (1.0, 3.3, 9.0):
        assert canvas.colour_at((x, 5.0), BLUE) == RED
        assert canvas.colour_at((x, 5.08), BLUE) == RED
        assert canvas.colour_at((x, 4.88), BLUE) == BLUE
    assert canvas.colour_at((9.08, 5.0), BLUE) == RED  # its ends are round
    assert canvas.colour_at((9.08, 5.08), BLUE) == BLUE


def test_the_newest_line_is_on_top(canvas: Canvas) -> None:
    """A line covers those below it."""
    canvas.draw(1, Pen(RED), (1.0, 1.0), (3.0, 3.0))
    canvas.draw(2, Pen(GREEN), (1.0, 3.0), (3.0, 1.0))
    assert canvas.colour_at((2.0, 2.0), BLUE) == GREEN
    assert canvas.colour_at((1.5, 1.5), BLUE) == RED


@pytest.mark.parametrize('place', [(0.0, 0.0), (FIELD, FIELD), (0.0, FIELD), (FIELD, 0.0)])
def test_corners(canvas: Canvas, place: tuple[float, float]) -> None:
    """Lines and places at the edge of the field are in the image."""
    assert canvas.colour_at(place, BLUE) == BLUE
    canvas.draw(1, Pen(RED), place, (5.0, 5.0))
    assert canvas.colour_at(place, BLUE) == RED


@pytest.mark.parametrize('width', [0, 1, 255])
def test_odd_widths(canvas: Canvas, width: int) -> None:
    """The widest pen paints everything near it, and one of width 0 still draws."""
    canvas.draw(1, Pen(RED, width), (0.1, 0.1), (0.2, 0.1))
    assert canvas.colour_at((0.15, 0.1), BLUE) == RED
    assert (canvas.colour_at((2.0, 2.0), BLUE) == RED) == (width == 255)


def test_the_image_is_that_of_the_field(canvas: Canvas) -> None:
    """Its first row is at the top; it is transparent where nothing is drawn."""
    canvas.draw(1, Pen(RED), (1.0, 9.0), (2.0, 9.0))
    image = np.asarray(Image.open(BytesIO(canvas.png())))
    assert image.shape == (SIDE_PX, SIDE_PX, 4)
    row, column = int((FIELD - 9.0) * UNIT_PX), int(1.5 * UNIT_PX)
    assert image[row, column].tolist() == [*RED, 255]
    assert image[column, row].tolist() == [0, 0, 0, 0]
    drawn = np.nonzero(image[..., 3])
    assert np.ptp(drawn[0]) < np.ptp(drawn[1])


def test_changes(canvas: Canvas) -> None:
    """What goes on with the same pen is one line; everything is told once."""
    thick = Pen(RED, 5)
    canvas.draw(1, thick, (0.0, 0.0), (1.0, 0.0))
    canvas.draw(2, thick, (1.0, 0.0), (5.0, 0.0))
    canvas.draw(1, thick, (1.0, 0.0), (1.0, 1.0))
    canvas.draw(1, Pen(RED, 6), (1.0, 1.0), (2.0, 1.0))
    canvas.draw(1, Pen(RED, 6), (3.0, 1.0), (4.0, 1.0))
    was_cleared, lines = canvas.take_changes()
    assert not was_cleared
    assert [(line.pen.width_px, len(line.points)) for line in lines] == [
        (10, 3),
        (10, 2),
        (12, 2),
        (12, 2),
    ]
    assert lines[0].points[0] == pytest.approx((0.0, SIDE_PX))
    assert canvas.take_changes() == (False, [])
    canvas.draw(1, thick, (1.0, 1.0), (1.0, 2.0))
    canvas.clear()
    assert canvas.is_blank
    assert canvas.take_changes() == (True, [])
    assert canvas.colour_at((1.0, 1.5), BLUE) == BLUE
