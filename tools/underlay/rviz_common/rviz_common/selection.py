# SPDX-License-Identifier: Apache-2.0
"""What a user selects in the scene: objects, the ray that finds one, and the selected object."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
import math
from typing import Optional

from rviz_common.frames import Pose

__all__ = ['Hit', 'Point', 'Ray', 'SceneObject', 'Selection', 'nearest']

Point = tuple[float, float, float]


@dataclass(frozen=True)
class Ray:
    """A half-line from the eye through the pointer; distances are multiples of its direction."""

    origin: Point
    direction: Point

    @classmethod
    def through(cls, origin: Point, point: Point) -> Ray:
        """
        Make the ray from one point through another, with a direction of length 1.

        Parameters
        ----------
        origin, point
            Two points, in m; if they are the same, the direction is zero.

        """
        length = math.dist(origin, point) or 1.0
        x, y, z = ((b - a) / length for a, b in zip(origin, point))
        return cls(origin, (x, y, z))

    def at(self, distance: float) -> Point:
        """
        Compute a point of the ray.

        Parameters
        ----------
        distance
            How many times the direction it is from the origin.

        """
        x, y, z = (a + distance * b for a, b in zip(self.origin, self.direction))
        return x, y, z

    def seen_from(self, pose: Pose) -> Ray:
        """
        Express the ray in the axes of a frame; distances stay the same.

        Parameters
        ----------
        pose
            The pose of the frame, in the frame of the ray.

        """
        back = pose.inverse()
        turn = Pose(wxyz=back.wxyz)
        return Ray(back.of(Pose(self.origin)).position, turn.of(Pose(self.direction)).position)


class SceneObject(ABC):
    """An object that a display has drawn, such as a link of a robot or a marker."""

    name: str
    """Its name for the user."""
    frame: str
    """The frame in which it was given."""

    @property
    @abstractmethod
    def is_present(self) -> bool:
        """Whether it is still in the scene."""

    @abstractmethod
    def pose(self) -> Pose | None:
        """Return its pose in the fixed frame, None if that is unknown."""

    @abstractmethod
    def details(self) -> list[tuple[str, str]]:
        """Return what else is known about it: names and values."""

    @abstractmethod
    def highlight(self, is_highlighted: bool) -> None:
        """
        Highlight it in the scene, or stop doing so.

        Parameters
        ----------
        is_highlighted
            Whether it is to be highlighted. False has no effect on what is no longer in the scene.

        """

    @property
    def entity(self) -> tuple[str, str] | None:
        """The names that a simulator has for it: of a robot or an object, and of the link."""
        return None

    def rigid_body(self) -> SceneObject:
        """Return the object whose frame a simulator moves with it: by default the object."""
        return self


@dataclass(frozen=True)
class Hit:
    """An object on a ray, and where the ray meets it."""

    distance: float
    found: SceneObject


Picker = Callable[[Ray], Optional[Hit]]
"""Finds the first object on a ray, such as the method `pick` of a group of displays."""


def nearest(hits: list[Hit | None]) -> Hit | None:
    """
    Return the hit that is nearest to the origin of the ray, None if there is none.

    Parameters
    ----------
    hits
        The hits on the same ray.

    """
    found = [each for each in hits if each is not None]
    return min(found, key=lambda hit: hit.distance, default=None)


class Selection:
    """
    The object that the user has selected, which is highlighted as long as it is in the scene.

    Parameters
    ----------
    pick
        Finds the first object on a ray, in the fixed frame.

    Attributes
    ----------
    chosen
        The selected object, None for none.

    """

    def __init__(self, pick: Picker) -> None:
        self.pick = pick
        self.chosen: SceneObject | None = None

    def choose(self, chosen: SceneObject | None) -> None:
        """
        Select an object instead of the one before.

        Parameters
        ----------
        chosen
            The object, None to select nothing.

        """
        if self.chosen is not None:
            self.chosen.highlight(False)
        self.chosen = chosen
        if chosen is not None:
            chosen.highlight(True)

    def update(self) -> None:
        """Deselect an object that is no longer in the scene."""
        if self.chosen is not None and not self.chosen.is_present:
            self.choose(None)
