# SPDX-License-Identifier: Apache-2.0
"""
Compute the ground-truth occupancy map of a scene, as a perfect mapper would build it.

Every part of a fixed object counts as convex: its section with a layer of heights is a convex
polygon, and a cell is occupied if the polygon and the cell overlap (separating axis theorem).
Visual parts that do not collide, such as leaves, count too, unless they are thinner than a cell: a
laser scanner sees them, but wallpaper must not make walls thicker.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
import math

from humanoid_description.rotations import from_rpy
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.scene.meshes import triangles_of
from humanoid_simulation.scene.outlines import Point
from humanoid_simulation.scene.parts import MESH, Part
from humanoid_simulation.scene.scene import Scene, Thing
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Cells = NDArray[np.int8]
UNKNOWN, FREE, OCCUPIED = -1, 0, 100
"""Cell values, as in `nav_msgs/msg/OccupancyGrid`."""
_MOST_CELLS = 25_000_000
_ROUND = 24
_TOUCH_M = 1e-6
"""Overlap below which a cell merely touches a solid, and is not occupied by it."""


@dataclass(frozen=True)
class Layer:
    """The range of heights whose objects are mapped."""

    low_m: float = 0.1
    high_m: float = 1.4

    def __post_init__(self) -> None:
        """Check that the heights are in order and in range."""
        if not (math.isfinite(self.low_m) and self.low_m <= self.high_m < 100.0):
            raise SimulationError(
                f'There is nothing between {self.low_m:g} and {self.high_m:g} m. Give the lower '
                'height first; give the same height twice to map a single one.'
            )


@dataclass(frozen=True, eq=False)
class OccupancyMap:
    """Occupancy grid: cells (rows, columns), in the order of increasing y and x."""

    cells: Cells
    resolution_m: float
    origin_m: Point
    """The lower left corner (x, y) of the first cell, in the world frame."""

    def at(self, x_m: float, y_m: float) -> int:
        """
        Look up the occupancy at a point.

        Parameters
        ----------
        x_m, y_m
            The point, in the world frame.

        Returns
        -------
        int
            FREE, OCCUPIED or UNKNOWN; UNKNOWN outside of the map.

        """
        column = math.floor((x_m - self.origin_m[0]) / self.resolution_m)
        row = math.floor((y_m - self.origin_m[1]) / self.resolution_m)
        rows, columns = self.cells.shape
        inside = 0 <= row < rows and 0 <= column < columns
        return int(self.cells[row, column]) if inside else UNKNOWN


def occupancy_of(
    scene: Scene,
    layer: Layer = Layer(),
    resolution_m: float = 0.05,
    start_m: Point = (0.0, 0.0),
    margin_m: float = 1.0,
) -> OccupancyMap:
    """
    Compute the occupancy map of the fixed objects of a scene.

    Cells that overlap a fixed object within the layer are occupied, also inside of solids; cells
    that a mapper can reach from its start within the map are free; all others are unknown.

    Parameters
    ----------
    scene
        The scene; movable objects are ignored.
    layer
        The range of heights to map.
    resolution_m
        Edge length of a cell.
    start_m
        Where the mapper starts (x, y), in the world frame.
    margin_m
        How far the map extends beyond all occupied cells and the start.

    Raises
    ------
    SimulationError
        The resolution is not in 0.005 to 1 m, the margin is less than a cell, the start is
        occupied, or there are too many cells.

    """
    if not 0.005 <= resolution_m <= 1.0:
        raise SimulationError(f'The cell size cannot be {resolution_m:g} m. Give 0.005 to 1 m.')
    if not margin_m >= resolution_m:
        raise SimulationError(
            f'A margin of {margin_m:g} m is too small. Give at least {resolution_m:g} m, the '
            'size of a cell.'
        )
    sections = [
        section
        for thing in scene.things
        if thing.is_fixed
        for part in thing.parts
        if (part.collides or (part.is_shown and min(part.box_m) >= resolution_m))
        and len(section := section_of(thing, part, layer)) > 0
    ]
    cells, origin_m = _empty(sections, resolution_m, start_m, margin_m)
    for section in sections:
        _fill(cells, (section - origin_m) / resolution_m, _TOUCH_M / resolution_m)
    start = (np.array(start_m) - origin_m) / resolution_m
    row, column = int(start[1]), int(start[0])
    if cells[row, column] == OCCUPIED:
        raise SimulationError(
            f'The mapper cannot start at {start_m[0]:g}, {start_m[1]:g}: something solid is there.'
        )
    _flood(cells, row, column)
    return OccupancyMap(cells, resolution_m, (float(origin_m[0]), float(origin_m[1])))


def section_of(thing: Thing, part: Part, layer: Layer) -> Array:
    """
    Compute the footprint of a convex part within a layer of heights.

    Parameters
    ----------
    thing
        The object that the part belongs to, at its initial pose in the world.
    part
        The part; its convex hull is used.
    layer
        The range of heights.

    Returns
    -------
    Array
        Corners (n, 2) of the convex footprint in m in the world frame, counter-clockwise; n is 0
        if the part is not in the layer.

    """
    corners = _corners(part) @ from_rpy(*part.orientation_rpy_rad).T + part.position_m
    corners = corners @ from_rpy(*thing.orientation_rpy_rad).T + thing.position_m
    heights = corners[:, 2]
    if heights.max() <= layer.low_m or heights.min() >= layer.high_m:
        return np.zeros((0, 2))
    within = (heights >= layer.low_m) & (heights <= layer.high_m)
    points = [corners[within, :2]]
    for height_m in (layer.low_m, layer.high_m):
        points.append(_crossings(corners, height_m))
    return _hull(np.vstack(points))


def _crossings(corners: Array, height_m: float) -> Array:
    """
    Compute the points (n, 2) at which lines between corners cross a height.

    Lines through the inside of the body only add points inside of the section.
    """
    above = corners[corners[:, 2] > height_m]
    below = corners[corners[:, 2] < height_m]
    if not (len(above) and len(below)):
        return np.zeros((0, 2))
    rise = above[:, None, 2] - below[None, :, 2]
    share = ((height_m - below[None, :, 2]) / rise)[..., None]
    crossings = below[None, :, :2] + share * (above[:, None, :2] - below[None, :, :2])
    return np.asarray(crossings.reshape(-1, 2))


def _corners(part: Part) -> Array:
    """Return points (n, 3) that span the hull of a part in its axes; round ones are faceted."""
    if part.shape == 'box':
        unit = [[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]
        return np.array(unit) * part.size_m
    if part.shape == MESH:
        corners = triangles_of(part.mesh).reshape(-1, 3).astype(np.float64)
        return np.asarray(np.unique(corners, axis=0) * part.size_m)
    turns = 2.0 * np.pi * np.arange(_ROUND) / _ROUND
    circle = np.column_stack([np.cos(turns), np.sin(turns)]) * part.size_m[0]
    if part.shape == 'cylinder':
        ends = (-part.size_m[1] / 2.0, part.size_m[1] / 2.0)
        return np.vstack([np.column_stack([circle, np.full(_ROUND, end)]) for end in ends])
    tilts = np.linspace(-np.pi / 2.0, np.pi / 2.0, _ROUND // 2 + 1)
    rings = [
        np.column_stack(
            [circle * math.cos(tilt), np.full(_ROUND, part.size_m[0] * math.sin(tilt))]
        )
        for tilt in tilts
    ]
    return np.vstack(rings)


def _hull(points: Array) -> Array:
    """Compute the convex hull of points, counter-clockwise (Andrew's monotone chain)."""
    ordered = sorted({(round(float(x), 9), round(float(y), 9)) for x, y in points})
    if len(ordered) < 3:
        return np.zeros((0, 2))

    def half(candidates: list[Point]) -> list[Point]:
        chain: list[Point] = []
        for point in candidates:
            while len(chain) > 1 and _turn(chain[-2], chain[-1], point) <= 1e-12:
                chain.pop()
            chain.append(point)
        return chain[:-1]

    hull = half(ordered) + half(ordered[::-1])
    return np.array(hull) if len(hull) > 2 else np.zeros((0, 2))


def _turn(a: Point, b: Point, c: Point) -> float:
    """Return twice the signed area of a triangle, positive for a left turn."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _empty(
    sections: list[Array], resolution_m: float, start_m: Point, margin_m: float
) -> tuple[Cells, Array]:
    """Return a grid of unknown cells around all sections and the start, and its origin."""
    points = np.vstack([np.array([start_m]), *sections])
    low = np.floor((points.min(axis=0) - margin_m) / resolution_m + 1e-6)
    high = np.ceil((points.max(axis=0) + margin_m) / resolution_m - 1e-6)
    columns, rows = (int(count) for count in high - low)
    if rows * columns > _MOST_CELLS:
        raise SimulationError(f'The map would have {rows} by {columns} cells. Give larger cells.')
    return np.full((rows, columns), UNKNOWN, dtype=np.int8), low * resolution_m


def _fill(cells: Cells, polygon: Array, slack: float) -> None:
    """Mark the cells that overlap a convex polygon, in units of cells, as occupied."""
    rows, columns = cells.shape
    low = np.clip(np.floor(polygon.min(axis=0) + slack).astype(int), 0, (columns, rows))
    high = np.clip(np.ceil(polygon.max(axis=0) - slack).astype(int), 0, (columns, rows))
    xs, ys = np.meshgrid(np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1]) + 0.5)
    overlaps = np.ones(xs.shape, dtype=bool)
    for start, end in _sides(polygon):
        normal = np.array([end[1] - start[1], start[0] - end[0]])
        normal /= np.hypot(*normal)
        reach = np.abs(normal).sum() / 2.0 - slack
        overlaps &= (xs - start[0]) * normal[0] + (ys - start[1]) * normal[1] < reach
    (left, bottom), (right, top) = low, high
    cells[bottom:top, left:right][overlaps] = OCCUPIED


def _sides(polygon: Array) -> Iterator[tuple[Array, Array]]:
    """Yield the sides of a polygon."""
    yield from zip(polygon, np.roll(polygon, -1, axis=0))


def _flood(cells: Cells, row: int, column: int) -> None:
    """Flood-fill the unknown cells that are 4-connected to a cell as free."""
    rows, columns = cells.shape
    cells[row, column] = FREE
    waiting = deque([(row, column)])
    while waiting:
        row, column = waiting.popleft()
        for next_row, next_column in (
            (row + 1, column),
            (row - 1, column),
            (row, column + 1),
            (row, column - 1),
        ):
            inside = 0 <= next_row < rows and 0 <= next_column < columns
            if inside and cells[next_row, next_column] == UNKNOWN:
                cells[next_row, next_column] = FREE
                waiting.append((next_row, next_column))
