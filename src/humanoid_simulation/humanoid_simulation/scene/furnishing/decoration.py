# SPDX-License-Identifier: Apache-2.0
"""Decoration: lamps, plants, rugs, pictures, windows and human figures."""

from __future__ import annotations

from humanoid_simulation.scene.parts import (
    box,
    DARK,
    darker,
    Finish,
    lighter,
    mesh,
    Part,
    Parts,
    rod,
    STEEL,
    Vector,
    WHITE,
    WOOD,
)

_SKIN = (0.87, 0.68, 0.55)


def plant(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a pot plant; its leaves do not collide.

    Parameters
    ----------
    size
        Length (x), which is also the diameter, width (unused) and height (z), in m.
    rgb
        Colour of the leaves, 0 to 1.

    """
    length, _, height = size
    radius = length / 2
    pot = 0.3 * height
    leaves = [
        Part('sphere', (0.62 * radius,), at, colour_rgba=(*rgb, 1.0), collides=False)
        for at in (
            (0.3 * radius, 0.2 * radius, 0.62 * height),
            (-0.3 * radius, 0.25 * radius, 0.7 * height),
            (0.0, -0.4 * radius, 0.66 * height),
            (0.05 * radius, 0.0, 0.86 * height),
        )
    ]
    return [
        rod(0.7 * radius, pot, (0, 0, pot / 2), (0.6, 0.33, 0.22)),
        rod(0.12 * radius, 0.4 * height, (0, 0, pot + 0.2 * height), WOOD),
        *leaves,
    ]


def lamp(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a floor lamp: a foot, a pole and a glowing shade, which does not collide.

    Parameters
    ----------
    size
        Length (x) and width (y) of the shade, and height of the lamp (z), in m.
    rgb
        Colour of the shade, 0 to 1.

    """
    length, width, height = size
    shade = min(0.3, 0.4 * height)
    return [
        rod(0.4 * length, 0.02, (0, 0, 0.01), DARK),
        rod(0.012, height - shade, (0, 0, (height - shade) / 2), STEEL),
        mesh('shade', (length, width, shade), (0, 0, height - shade / 2), rgb, shine=0.5),
    ]


def ceiling_lamp(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a ceiling lamp, which hangs down from the origin and does not collide.

    Parameters
    ----------
    size
        Length (x) and width (y) of the shade, and height of the lamp (z), in m.
    rgb
        Colour of the shade, 0 to 1.

    """
    length, width, height = size
    shade = 0.6 * height
    return [
        rod(0.008, height - shade, (0, 0, -(height - shade) / 2), DARK, hits=False),
        mesh('shade', (length, width, shade), (0, 0, shade / 2 - height), rgb, shine=0.6),
    ]


def rug(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a rug, which does not collide.

    Parameters
    ----------
    size
        Length (x), width (y) and thickness (z), in m; a border adds 0.1 m to length and width.
    rgb
        Main colour, 0 to 1; the stripes and the border are darker.

    """
    finish = Finish('stripes', rgb, darker(rgb, 0.8), 0.25)
    border = (size[0] + 0.1, size[1] + 0.1, 0.003)
    top = Part('box', size, (0, 0, 0.004), colour_rgba=(*rgb, 1.0), collides=False, finish=finish)
    return [box(border, (0, 0, 0.0025), darker(rgb, 0.6), hits=False), top]


def picture(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a framed picture for a wall, which does not collide.

    Parameters
    ----------
    size
        Depth (x, to the front), width (y) and height (z) about the origin, in m.
    rgb
        Main colour of the picture, 0 to 1.

    """
    length, width, height = size
    blot = (0.004, 0.35 * width, 0.35 * height)
    return [
        box((length, width, height), (0, 0, 0), darker(WOOD, 0.7), hits=False),
        box((0.004, width - 0.06, height - 0.06), (length / 2, 0, 0), rgb, hits=False),
        box(blot, (length / 2 + 0.002, -0.15 * width, 0.1 * height), lighter(rgb), hits=False),
        box(blot, (length / 2 + 0.003, 0.12 * width, -0.12 * height), darker(rgb), hits=False),
    ]


def window(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a window that hangs on a wall and does not collide.

    Parameters
    ----------
    size
        Depth (x, to the front), width (y) and height (z) about the origin, in m.
    rgb
        Colour of the glowing panes, 0 to 1.

    """
    length, width, height = size
    panes = [
        Part(
            'box',
            (0.004, width / 2 - 0.07, height - 0.1),
            (length / 2, side * (width / 4 - 0.005), 0.0),
            colour_rgba=(*rgb, 1.0),
            collides=False,
            shine=0.4,
        )
        for side in (-1, 1)
    ]
    return [box((length, width, height), (0, 0, 0), WHITE, hits=False), *panes]


def person(size: Vector, rgb: Vector) -> Parts:
    """
    Build the parts of a standing person.

    Parameters
    ----------
    size
        Length (unused), width across the arms (y) and height (z), in m.
    rgb
        Colour of the shirt, 0 to 1.

    """
    _, width, height = size
    trousers = (0.22, 0.24, 0.33)
    hip, shoulder = 0.48 * height, 0.82 * height
    legs = [rod(0.075, hip, (0, side * 0.09, hip / 2), trousers) for side in (-1, 1)]
    shoes = [box((0.26, 0.1, 0.08), (0.04, side * 0.09, 0.04), DARK) for side in (-1, 1)]
    arms = [
        rod(0.045, 0.36 * height, (0, side * (width / 2 - 0.05), 0.64 * height), rgb)
        for side in (-1, 1)
    ]
    hands = [
        Part('sphere', (0.05,), (0, side * (width / 2 - 0.05), 0.44 * height),
             colour_rgba=(*_SKIN, 1.0))
        for side in (-1, 1)
    ]  # fmt: skip
    trunk = shoulder - hip
    return [
        *legs,
        *shoes,
        *arms,
        *hands,
        Part(
            'box', (0.2, width - 0.2, trunk), (0, 0, hip + trunk / 2), colour_rgba=(*rgb, 1.0),
            is_shown=False,
        ),
        mesh('trunk', (0.24, width - 0.16, trunk + 0.04), (0, 0, hip + trunk / 2), rgb),
        rod(0.05, 0.08, (0, 0, shoulder + 0.03), _SKIN),
        Part('sphere', (0.105,), (0, 0, height - 0.11), colour_rgba=(*_SKIN, 1.0)),
        Part(
            'sphere', (0.108,), (-0.022, 0, height - 0.088), colour_rgba=(0.25, 0.17, 0.1, 1.0),
            collides=False,
        ),
    ]  # fmt: skip
