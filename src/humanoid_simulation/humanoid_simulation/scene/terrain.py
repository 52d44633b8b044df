# SPDX-License-Identifier: Apache-2.0
"""Uneven terrain, made of boxes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
import math

from humanoid_simulation.errors import SimulationError
from humanoid_simulation.scene.scene import Thing, Vector
import numpy as np

_WOOD = (0.55, 0.45, 0.35, 1.0)
_THICKNESS_M = 0.2
_MOST_PLATES = 2000


@dataclass(frozen=True)
class Ramp:
    """A ramp: an incline, and optionally a level top and the same incline down."""

    name: str
    start_m: Vector
    """The centre of its lower edge, on the ground."""
    direction_rad: float
    slope_rad: float
    length_m: float
    """The horizontal length of an incline."""
    width_m: float
    top_m: float = 0.0
    """The length of the top; 0 for neither a top nor an incline down."""

    def __post_init__(self) -> None:
        """Validate the slope and the dimensions."""
        if not 0.0 < self.slope_rad <= math.radians(45.0):
            raise SimulationError(
                f"Ramp '{self.name}' cannot have a slope of {math.degrees(self.slope_rad):g} "
                'degrees. Give more than 0, up to 45.'
            )
        if self.length_m <= 0.0 or self.width_m <= 0.0 or self.top_m < 0.0:
            raise SimulationError(f"Ramp '{self.name}' needs a length and a width above zero.")


def ramp_of(ramp: Ramp) -> Iterator[Thing]:
    """
    Build a ramp: an inclined board, and a level top and a board down if it has a top.

    Parameters
    ----------
    ramp
        Its geometry.

    Yields
    ------
    Thing
        A fixed box in the world frame.

    """
    height_m = ramp.length_m * math.tan(ramp.slope_rad)
    yield _incline(ramp, 'up', ramp.length_m / 2, -ramp.slope_rad)
    if ramp.top_m > 0.0:
        middle_m = ramp.length_m + ramp.top_m / 2
        yield Thing(
            f'{ramp.name}_top',
            'box',
            (ramp.top_m, ramp.width_m, height_m),
            (*_along(ramp, middle_m), height_m / 2),
            (0.0, 0.0, ramp.direction_rad),
            _WOOD,
        )
        yield _incline(ramp, 'down', 1.5 * ramp.length_m + ramp.top_m, ramp.slope_rad)


def _incline(ramp: Ramp, part: str, middle_m: float, pitch_rad: float) -> Thing:
    """Build a board whose upper face leads from the ground to the full height."""
    board_m = ramp.length_m / math.cos(pitch_rad)
    # From the centre of the upper face to that of the board: half its thickness, inwards.
    back_m = _THICKNESS_M / 2 * math.sin(pitch_rad)
    height_m = ramp.length_m / 2 * math.tan(ramp.slope_rad)
    return Thing(
        f'{ramp.name}_{part}',
        'box',
        (board_m, ramp.width_m, _THICKNESS_M),
        (*_along(ramp, middle_m - back_m), height_m - _THICKNESS_M / 2 * math.cos(pitch_rad)),
        (0.0, pitch_rad, ramp.direction_rad),
        _WOOD,
    )


def _along(ramp: Ramp, distance_m: float) -> Vector:
    """Return the point on the ground at a distance along the ramp."""
    x_m, y_m = ramp.start_m
    return (
        x_m + distance_m * math.cos(ramp.direction_rad),
        y_m + distance_m * math.sin(ramp.direction_rad),
    )


@dataclass(frozen=True)
class Plates:
    """A grid of plates of random heights on a rectangle of the ground."""

    name: str
    seed: int
    from_m: Vector
    """The corner of the rectangle with the smaller coordinates."""
    to_m: Vector
    """The opposite corner."""
    edge_m: Vector
    """Length and width of a plate."""
    height_m: float
    """The maximum height."""
    cover: float = 1.0
    """The expected fraction of the grid that has plates, above 0 and up to 1."""

    def __post_init__(self) -> None:
        """Validate the dimensions and the number of plates."""
        if not (min(self.edge_m) > 0.0 and self.height_m > 0.0 and 0.0 < self.cover <= 1.0):
            raise SimulationError(
                f"Plates '{self.name}' need edges and a height above zero, and a cover of at "
                'most 1.'
            )
        rows, columns = self.counts
        if not (rows > 0 and columns > 0 and rows * columns <= _MOST_PLATES):
            raise SimulationError(
                f"Plates '{self.name}' would form a grid of {rows} by {columns}. Give corners of "
                f'which the second has the larger coordinates, and room for 1 to {_MOST_PLATES} '
                'plates.'
            )

    @property
    def counts(self) -> tuple[int, int]:
        """Return the number of plates that fit along x and y."""
        places = [(b - a) / edge for a, b, edge in zip(self.from_m, self.to_m, self.edge_m)]
        rows, columns = (math.floor(max(-1e9, min(count, 1e9)) + 1e-9) for count in places)
        return rows, columns


def plates_of(plates: Plates) -> Iterator[Thing]:
    """
    Build a field of plates of random heights, which are reproducible for a seed.

    Parameters
    ----------
    plates
        The field.

    Yields
    ------
    Thing
        A fixed box; the height of its upper face is uniformly distributed up to `height_m`, but at
        least 5 % of that.

    """
    random = np.random.default_rng(plates.seed)
    rows, columns = plates.counts
    for row, column in np.ndindex(rows, columns):
        height_m, place = random.random(2)
        if place < plates.cover:
            yield _plate(plates, row, column, max(0.05, float(height_m)) * plates.height_m)


def _plate(plates: Plates, row: int, column: int, height_m: float) -> Thing:
    """Build a plate, which is sunk into the ground so that no edge is thin."""
    length_m, width_m = plates.edge_m
    shade = 0.35 + 0.4 * height_m / plates.height_m
    return Thing(
        f'{plates.name}_{row}_{column}',
        'box',
        (length_m, width_m, _THICKNESS_M),
        (
            plates.from_m[0] + (row + 0.5) * length_m,
            plates.from_m[1] + (column + 0.5) * width_m,
            height_m - _THICKNESS_M / 2,
        ),
        colour_rgba=(shade, 0.8 * shade, 0.6 * shade, 1.0),
    )
