# SPDX-License-Identifier: Apache-2.0
"""Tables, chairs, sofas, beds and televisions."""

from __future__ import annotations

from humanoid_simulation.scene.parts import (
    BOARD_M,
    box,
    darker,
    lighter,
    Parts,
    rod,
    Vector,
    WHITE,
    WOOD,
)


def table(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a table: a board on four legs.

    Parameters
    ----------
    size
        Length (x, to the front), width (y) and height (z), in m.
    rgb
        Colour of the board, 0 to 1; the legs are darker.

    """
    length, width, height = size
    leg = 0.05
    x, y = length / 2 - leg, width / 2 - leg
    under = height - BOARD_M
    return [
        box((length, width, BOARD_M), (0, 0, height - BOARD_M / 2), rgb),
        *(
            box((leg, leg, under), (sx * x, sy * y, under / 2), darker(rgb))
            for sx in (-1, 1)
            for sy in (-1, 1)
        ),
    ]


def chair(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a chair with a back.

    Parameters
    ----------
    size
        Length (x, to the front), width (y) and height of the back (z), in m; the seat is at 0.45
        m.
    rgb
        Colour of seat and back, 0 to 1; the legs are darker.

    """
    length, width, height = size
    seat, leg = 0.45, 0.035
    x, y = length / 2 - leg / 2, width / 2 - leg / 2
    return [
        box((length, width, 0.035), (0, 0, seat), rgb),
        box((0.03, width, 0.3), (-x, 0, height - 0.15), rgb),
        *(box((leg, leg, seat), (x, side * y, seat / 2), darker(rgb)) for side in (-1, 1)),
        *(box((leg, leg, height), (-x, side * y, height / 2), darker(rgb)) for side in (-1, 1)),
    ]


def sofa(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a sofa; its back cushions do not collide.

    Parameters
    ----------
    size
        Length (x, to the front), width (y) and height (z), in m.
    rgb
        Colour of the cover, 0 to 1.

    """
    length, width, height = size
    seat, arm, back = 0.42, 0.16, 0.2
    cushions = max(1, round((width - 2 * arm) / 0.65))
    wide = (width - 2 * arm) / cushions
    parts = [
        box((length, width, seat - 0.12), (0, 0, (seat - 0.12) / 2), darker(rgb, 0.8)),
        box((back, width, height), (-(length - back) / 2, 0, height / 2), rgb),
        *(
            box((length, arm, seat + 0.15), (0, side * (width - arm) / 2, (seat + 0.15) / 2), rgb)
            for side in (-1, 1)
        ),
    ]
    for number in range(cushions):
        y = wide * (number + 0.5 - cushions / 2)
        cushion = (length - back - 0.02, wide - 0.02, 0.12)
        parts.append(box(cushion, (back / 2, y, seat - 0.06), lighter(rgb)))
        pillow = (0.1, wide - 0.06, 0.3)
        at = (-length / 2 + back + 0.05, y, seat + 0.15)
        parts.append(box(pillow, at, lighter(rgb), turn=(0, -0.2, 0), hits=False))
    return parts


def bed(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a bed; blanket and pillows do not collide.

    Parameters
    ----------
    size
        Length (x, head at the back), width (y) and height of the mattress (z), in m.
    rgb
        Colour of the blanket, 0 to 1.

    """
    length, width, height = size
    frame, head = 0.28, height + 0.4
    x = -length / 2
    parts = [
        box((length, width, frame), (0, 0, frame / 2), WOOD),
        box((0.06, width, head), (x + 0.03, 0, head / 2), darker(WOOD)),
        box((length - 0.1, width - 0.06, height - frame), (0.02, 0, (height + frame) / 2), WHITE),
        box((0.62 * length, width, 0.03), (0.18 * length, 0, height + 0.01), rgb, hits=False),
    ]
    for side in (-1, 1):
        hang = (0.62 * length, 0.015, 0.24)
        at = (0.18 * length, side * (width / 2 + 0.008), height - 0.1)
        parts.append(box(hang, at, rgb, hits=False))
    for side in (-1, 1) if width > 1.2 else (0,):
        pillow = (0.36, min(0.6, width / 2 - 0.1), 0.12)
        at = (x + 0.32, side * width / 4, height + 0.05)
        parts.append(box(pillow, at, lighter(rgb), hits=False))
    return parts


def television(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a television on a foot.

    Parameters
    ----------
    size
        Length of the foot (x, to the front), width (y) and height (z), in m.
    rgb
        Colour of the case, 0 to 1.

    """
    length, width, height = size
    return [
        box((length, 0.3 * width, 0.015), (0, 0, 0.0075), rgb),
        rod(0.025, 0.1, (0, 0, 0.06), rgb),
        box((0.04, width, height - 0.1), (0, 0, 0.1 + (height - 0.1) / 2), rgb),
        box(
            (0.004, width - 0.04, height - 0.14),
            (0.021, 0, 0.1 + (height - 0.1) / 2),
            (0.12, 0.2, 0.32),
            hits=False,
        ),
    ]
