# SPDX-License-Identifier: Apache-2.0
"""The kinds of furniture, lamps and human figures, and the pieces of a scene file."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from humanoid_simulation.errors import SimulationError
from humanoid_simulation.scene.furnishing import decoration, seating, storage
from humanoid_simulation.scene.outlines import rectangle
from humanoid_simulation.scene.parts import darker, Parts, STEEL, Vector, WHITE, WOOD
from humanoid_simulation.scene.scene import COMPOSED, Surface, Thing

_LIGHT_RGB = (1.0, 0.95, 0.75)


@dataclass(frozen=True)
class Kind:
    """
    A kind of furniture: its builder, and its default size and colour.

    Sizes are length, width and height; x points to the front of the piece, so the length of a
    cupboard is its depth.
    """

    build: Callable[[Vector, Vector], Parts]
    size_m: Vector
    rgb: Vector
    levels: tuple[float, ...] = ()
    """Heights of its support surfaces, as fractions of its height; the main one comes first."""
    margin_m: float = 0.03
    """The margin along the edges of a surface on which no object may stand."""


@dataclass(frozen=True)
class Piece:
    """A piece of furniture, with its position and heading."""

    name: str
    kind: str
    x_m: float
    y_m: float
    yaw_rad: float = 0.0
    size_m: Vector | None = None
    rgb: Vector | None = None
    raised_m: float = 0.0
    """The height at which it stands or hangs."""


def furniture_of(piece: Piece) -> Thing:
    """
    Build a piece of furniture as a fixed object.

    Parameters
    ----------
    piece
        The piece to build; its kind is one of `KINDS`.

    Returns
    -------
    Thing
        The object, with its origin on its support or where it hangs; x points to its front.

    Raises
    ------
    SimulationError
        An edge of its size is below 1 mm.

    """
    kind = KINDS[piece.kind]
    size_m, rgb = piece.size_m or kind.size_m, piece.rgb or kind.rgb
    if min(size_m) < 0.001:
        raise SimulationError(f"'{piece.name}' needs a size of 1 mm or more, not {size_m}.")
    return Thing(
        piece.name,
        COMPOSED,
        size_m,
        (piece.x_m, piece.y_m, piece.raised_m),
        (0.0, 0.0, piece.yaw_rad),
        (*rgb, 1.0),
        kind=piece.kind,
        details=tuple(kind.build(size_m, rgb)),
    )


def surfaces_of(piece: Piece) -> Iterator[Surface]:
    """
    List the surfaces of a piece of furniture that objects can stand on.

    Parameters
    ----------
    piece
        The piece; its kind is one of `KINDS`.

    Yields
    ------
    Surface
        In the world frame; the main one comes first and has the name of the piece.

    """
    kind = KINDS[piece.kind]
    length_m, width_m, height_m = piece.size_m or kind.size_m
    inner = length_m - 2 * kind.margin_m, width_m - 2 * kind.margin_m
    outline = rectangle((piece.x_m, piece.y_m), *inner, piece.yaw_rad)
    for number, level in enumerate(kind.levels):
        name = f'{piece.name}/{number}' if number else piece.name
        yield Surface(name, outline, piece.raised_m + level * height_m)


KINDS: dict[str, Kind] = {
    'table': Kind(seating.table, (0.8, 1.2, 0.7), WOOD, (1.0,)),
    'counter': Kind(storage.counter, (0.6, 1.8, 0.8), WHITE, (1.0,)),
    'sink': Kind(storage.sink, (0.4, 0.5, 0.01), STEEL),
    'hob': Kind(storage.hob, (0.5, 0.55, 0.01), (0.06, 0.06, 0.07)),
    'fridge': Kind(storage.fridge, (0.6, 0.6, 1.6), (0.88, 0.89, 0.9)),
    'wardrobe': Kind(storage.wardrobe, (0.6, 1.4, 2.0), WOOD),
    'cabinet': Kind(storage.cabinet, (0.4, 1.2, 0.7), WOOD, (1.0,)),
    'shelf': Kind(storage.shelf, (0.35, 1.0, 0.8), WOOD, (1.0, storage.SHELF_LEVEL)),
    'bookcase': Kind(storage.bookcase, (0.3, 1.0, 1.8), darker(WOOD, 0.8)),
    'sofa': Kind(seating.sofa, (0.9, 1.9, 0.8), (0.25, 0.42, 0.45)),
    'bed': Kind(seating.bed, (2.0, 1.5, 0.5), (0.3, 0.4, 0.65), (1.0,), 0.1),
    'chair': Kind(seating.chair, (0.42, 0.42, 0.85), WOOD),
    'bin': Kind(storage.waste_bin, (0.3, 0.3, 0.45), (0.3, 0.32, 0.34), (1.0,)),
    'television': Kind(seating.television, (0.2, 1.1, 0.72), (0.05, 0.05, 0.06)),
    'plant': Kind(decoration.plant, (0.45, 0.45, 1.0), (0.18, 0.42, 0.2)),
    'lamp': Kind(decoration.lamp, (0.4, 0.4, 1.5), _LIGHT_RGB),
    'ceiling_lamp': Kind(decoration.ceiling_lamp, (0.4, 0.4, 0.4), _LIGHT_RGB),
    'rug': Kind(decoration.rug, (1.6, 2.2, 0.004), (0.6, 0.25, 0.22)),
    'picture': Kind(decoration.picture, (0.03, 0.7, 0.5), (0.35, 0.5, 0.6)),
    'window': Kind(decoration.window, (0.04, 1.4, 1.1), (0.72, 0.85, 0.95)),
    'person': Kind(decoration.person, (0.3, 0.52, 1.7), (0.4, 0.55, 0.4)),
}
"""All kinds, by their names in scene files."""
HANGING = ('ceiling_lamp', 'picture', 'window')
"""Kinds that hang on walls or from ceilings, which may be cut off in a view."""
