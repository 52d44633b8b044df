# SPDX-License-Identifier: Apache-2.0
"""Named places: surfaces that objects stand on, and rooms, with their outlines."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
import math

__all__ = ['TOLERANCE_M', 'Fixture', 'Outline', 'Places', 'Point', 'Room', 'Surface', 'sides']

Point = tuple[float, float]
Outline = tuple[Point, ...]
TOLERANCE_M = 0.08
"""Default tolerance of the outline and the height of a surface."""
_MOST_SIGMA_M = 0.1
"""Largest position uncertainty that widens the tolerance of a surface."""


class _Area:
    """Base class of areas with an outline in the map."""

    outline_m: Outline

    @property
    def middle_m(self) -> Point:
        """Return the mean of the corners, in the map."""
        return _mean(self.outline_m)

    def distance_m(self, point_m: Point) -> float:
        """
        Compute the horizontal distance of a point from the area.

        Parameters
        ----------
        point_m
            x and y in the map.

        Returns
        -------
        float
            The distance in m; 0 within the outline.

        """
        if _contains(self.outline_m, point_m):
            return 0.0
        return min(_to_side_m(a, b, point_m) for a, b in sides(self.outline_m))


@dataclass(frozen=True)
class Fixture(_Area):
    """
    A permanent object on a surface, such as a television.

    Attributes
    ----------
    outline_m
        Its outline in the map.
    height_m
        Its height above the surface.

    """

    outline_m: Outline
    height_m: float


@dataclass(frozen=True)
class Surface(_Area):
    """
    A named horizontal surface.

    Attributes
    ----------
    name
        Its name.
    outline_m, height_m
        Its outline and height in the map.
    tolerance_m
        The tolerance of outline and height.
    depth_m
        Its thickness, as of a table top; zero for a body down to the floor, such as a cabinet.
    is_container
        Whether it is the opening of a container, such as a bin: an object put there falls in.
    fixtures
        The permanent objects on it.

    """

    name: str
    outline_m: Outline
    height_m: float
    tolerance_m: float = TOLERANCE_M
    depth_m: float = 0.0
    is_container: bool = False
    fixtures: tuple[Fixture, ...] = ()

    def misfit_m(self, x_m: float, y_m: float, bottom_m: float, sigma_m: float = 0.0) -> float:
        """
        Compute the height difference between the underside of an object and the surface.

        Parameters
        ----------
        x_m, y_m, bottom_m
            The centre of its underside, in the map.
        sigma_m
            The standard deviation of its position.

        Returns
        -------
        float
            The height difference in m; infinite if the object is farther above, below or beside
            the surface than the tolerance and two standard deviations.

        """
        above_m = abs(bottom_m - self.height_m)
        reach_m = self.tolerance_m + 2.0 * min(sigma_m, _MOST_SIGMA_M)
        is_on = above_m <= reach_m and self.distance_m((x_m, y_m)) <= reach_m
        return above_m if is_on else math.inf


@dataclass(frozen=True)
class Room(_Area):
    """A named part of the floor, with its outline in the map."""

    name: str
    outline_m: Outline


@dataclass(frozen=True)
class Places:
    """All named places, in a frame."""

    frame: str = 'map'
    surfaces: tuple[Surface, ...] = ()
    rooms: tuple[Room, ...] = ()

    @property
    def names(self) -> list[str]:
        """Return the names of the surfaces and rooms."""
        return [*(each.name for each in self.surfaces), *(each.name for each in self.rooms)]

    def surface_at(self, x_m: float, y_m: float, bottom_m: float, sigma_m: float = 0.0) -> str:
        """
        Find the surface below an object; return its name, or empty if it stands on none.

        Parameters
        ----------
        x_m, y_m, bottom_m
            The centre of its underside, in the map.
        sigma_m
            The standard deviation of its position.

        """
        fits = [(each.misfit_m(x_m, y_m, bottom_m, sigma_m), each.name) for each in self.surfaces]
        best = min(fits, default=(math.inf, ''))
        return best[1] if best[0] < math.inf else ''

    def room_at(self, x_m: float, y_m: float) -> str:
        """
        Find the room around a point.

        Parameters
        ----------
        x_m, y_m
            The point, in the frame of the places.

        Returns
        -------
        str
            The name of the room; empty outside all rooms.

        """
        return next(
            (each.name for each in self.rooms if _contains(each.outline_m, (x_m, y_m))), ''
        )


def sides(outline: Outline) -> Iterable[tuple[Point, Point]]:
    """
    Iterate over the sides of a polygon as pairs of end points; the last one closes it.

    Parameters
    ----------
    outline
        The corners of the polygon, in order.

    """
    return zip(outline, (*outline[1:], outline[0]))


def _contains(outline: Outline, point: Point) -> bool:
    """Whether a point is inside a polygon: a ray from it crosses an odd number of sides."""
    x, y = point
    return (
        sum(
            (y1 > y) != (y2 > y) and x < x1 + (y - y1) / (y2 - y1) * (x2 - x1)
            for (x1, y1), (x2, y2) in sides(outline)
        )
        % 2
        == 1
    )


def _to_side_m(a: Point, b: Point, point: Point) -> float:
    """Compute the distance of a point from a line segment."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    length2 = dx * dx + dy * dy
    along = ((point[0] - a[0]) * dx + (point[1] - a[1]) * dy) / length2 if length2 else 0.0
    along = max(0.0, min(1.0, along))
    return math.hypot(a[0] + along * dx - point[0], a[1] + along * dy - point[1])


def _mean(outline: Outline) -> Point:
    count = len(outline)
    return sum(each[0] for each in outline) / count, sum(each[1] for each in outline) / count
