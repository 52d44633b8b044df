# SPDX-License-Identifier: Apache-2.0
"""Kitchen and storage furniture: counters, cupboards, shelves and bins."""

from __future__ import annotations

from humanoid_simulation.scene.parts import (
    ACROSS,
    BOARD_M,
    box,
    DARK,
    darker,
    Parts,
    rod,
    STEEL,
    Vector,
    WOOD,
)

SHELF_LEVEL = 0.55
"""The height of the middle board of a shelf, as a fraction of its height."""


def counter(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a kitchen counter: cupboards below a worktop.

    Parameters
    ----------
    size
        Length (x, to the front), width (y) and height (z), in m.
    rgb
        Colour of the cupboards, 0 to 1.

    """
    length, width, height = size
    top = 0.04
    parts = [
        box((length, width, height - top), (0, 0, (height - top) / 2), rgb),
        box((length + 0.02, width, top), (0.01, 0, height - top / 2), darker(WOOD, 0.9)),
    ]
    doors = max(1, round(width / 0.6))
    for number in range(doors):
        y = width * ((number + 0.5) / doors - 0.5)
        front = (0.012, width / doors - 0.02, height - 0.2)
        parts.append(box(front, (length / 2, y, height / 2), darker(rgb, 0.92), hits=False))
        handle = (0.02, 0.14, 0.015)
        parts.append(box(handle, (length / 2 + 0.012, y, height - 0.16), STEEL, hits=False))
    return parts


def sink(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a sink on top of a counter; the basin does not collide, its tap does.

    Parameters
    ----------
    size
        Length (x, to the front), width (y) and height (unused), in m.
    rgb
        Colour of the basin, 0 to 1.

    """
    length, width, _ = size
    return [
        box((length, width, 0.004), (0, 0, 0.002), rgb, hits=False),
        box((0.8 * length, 0.8 * width, 0.002), (0.02, 0, 0.005), darker(rgb), hits=False),
        rod(0.012, 0.22, (-0.42 * length, 0, 0.11), STEEL),
        rod(0.01, 0.16, (-0.42 * length + 0.07, 0, 0.22), STEEL, turn=ACROSS),
    ]


def hob(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a hob on top of a counter, which does not collide.

    Parameters
    ----------
    size
        Length (x, to the front), width (y) and height (unused), in m.
    rgb
        Colour of the glass, 0 to 1.

    """
    length, width, _ = size
    plates = [
        rod(0.08, 0.002, (sx * length / 4, sy * width / 4, 0.005), (0.35, 0.1, 0.08), hits=False)
        for sx in (-1, 1)
        for sy in (-1, 1)
    ]
    return [box((length, width, 0.004), (0, 0, 0.002), rgb, hits=False), *plates]


def fridge(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a fridge with two doors.

    Parameters
    ----------
    size
        Length (x, to the front), width (y) and height (z), in m.
    rgb
        Colour of the case, 0 to 1.

    """
    length, width, height = size
    x = length / 2 + 0.005
    parts = [box(size, (0, 0, height / 2), rgb)]
    for low, high in ((0.02, 0.36), (0.38, 0.98)):
        front = (0.01, width - 0.02, (high - low) * height)
        parts.append(box(front, (x, 0, (low + high) / 2 * height), darker(rgb, 0.96), hits=False))
    for at in (0.3, 0.5):
        handle = (0.025, 0.025, 0.22)
        parts.append(box(handle, (x + 0.02, 0.4 * width, at * height), darker(STEEL), hits=False))
    return parts


def wardrobe(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a wardrobe with two doors.

    Parameters
    ----------
    size
        Length (x, to the front), width (y) and height (z), in m.
    rgb
        Colour of the case, 0 to 1; the doors are darker.

    """
    length, width, height = size
    x = length / 2 + 0.006
    parts = [box(size, (0, 0, height / 2), rgb)]
    for side in (-1, 1):
        front = (0.012, width / 2 - 0.015, height - 0.1)
        parts.append(box(front, (x, side * width / 4, height / 2), darker(rgb, 0.9), hits=False))
        parts.append(box((0.03, 0.02, 0.2), (x + 0.01, side * 0.05, height / 2), DARK, hits=False))
    return parts


def cabinet(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a cabinet: drawers below a top.

    Parameters
    ----------
    size
        Length (x, to the front), width (y) and height (z), in m.
    rgb
        Colour of the case, 0 to 1; the top is darker.

    """
    length, width, height = size
    rows, columns = max(1, round(height / 0.25)), max(1, round(width / 0.8))
    parts = [
        box((length - 0.02, width - 0.02, height), (0, 0, height / 2), rgb),
        box((length, width, BOARD_M), (0, 0, height - BOARD_M / 2), darker(rgb, 0.85)),
    ]
    tall, wide = (height - 0.08) / rows, (width - 0.04) / columns
    for row in range(rows):
        for column in range(columns):
            z, y = 0.03 + tall * (row + 0.5), wide * (column + 0.5 - columns / 2)
            front = (0.012, wide - 0.02, tall - 0.02)
            parts.append(box(front, (length / 2 - 0.006, y, z), darker(rgb, 0.92), hits=False))
            parts.append(box((0.02, 0.1, 0.012), (length / 2 + 0.006, y, z), DARK, hits=False))
    return parts


def shelf(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a shelf: three boards between two sides, with a back.

    Parameters
    ----------
    size
        Length (x, to the front), width (y) and height (z), in m.
    rgb
        Colour of the sides, 0 to 1; back and boards are darker.

    """
    length, width, height = size
    inner = width - 2 * BOARD_M
    parts = [
        box((length, BOARD_M, height), (0, side * (width - BOARD_M) / 2, height / 2), rgb)
        for side in (-1, 1)
    ]
    back = (0.01, inner, height)
    parts.append(box(back, (-length / 2 + 0.005, 0, height / 2), darker(rgb, 0.8)))
    for level in (1.0, SHELF_LEVEL, 0.1):
        at = level * height - BOARD_M / 2
        parts.append(box((length, inner, BOARD_M), (0, 0, at), darker(rgb, 0.9)))
    return parts


def bookcase(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a bookcase full of books, which do not collide.

    Parameters
    ----------
    size
        Length (x, to the front), width (y) and height (z), in m.
    rgb
        Colour of sides and boards, 0 to 1.

    """
    length, width, height = size
    parts = shelf(size, rgb)[:3]
    inner, rows = width - 2 * BOARD_M, max(2, round(height / 0.35))
    colours = ((0.5, 0.16, 0.14), (0.2, 0.3, 0.45), (0.75, 0.65, 0.4), (0.25, 0.4, 0.3), DARK)
    for row in range(rows + 1):
        z = row * (height - BOARD_M) / rows + BOARD_M / 2
        parts.append(box((length, inner, BOARD_M), (0, 0, z), rgb))
    tall = (height - BOARD_M) / rows
    for row in range(rows):
        y, number = -inner / 2, row
        while y < inner / 2 - 0.12:
            wide = 0.08 + 0.03 * (number % 3)
            high = (0.62 + 0.1 * (number % 4)) * (tall - BOARD_M)
            z = row * tall + BOARD_M + high / 2
            book = (0.7 * length, wide - 0.004, high)
            parts.append(box(book, (0, y + wide / 2, z), colours[number % 5], hits=False))
            y, number = y + wide, number + 1 + row
    return parts


def waste_bin(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a waste bin, which is open at the top so that objects fall in.

    Parameters
    ----------
    size
        Length (x, to the front), width (y) and height (z), in m.
    rgb
        Colour of the walls, 0 to 1; the bottom is darker.

    """
    length, width, height = size
    wall = 0.012
    x, y = (length - wall) / 2, (width - wall) / 2
    return [
        box((length, width, wall), (0, 0, wall / 2), darker(rgb, 0.6)),
        *(box((wall, width, height), (side * x, 0, height / 2), rgb) for side in (-1, 1)),
        *(box((length, wall, height), (0, side * y, height / 2), rgb) for side in (-1, 1)),
    ]
