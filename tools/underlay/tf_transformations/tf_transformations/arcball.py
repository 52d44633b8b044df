# SPDX-License-Identifier: Apache-2.0
"""
A virtual trackball: turn an object by dragging a point of a window.

K. Shoemake, "ARCBALL: a user interface for specifying three-dimensional orientation using a
mouse", 1992.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike
from tf_transformations.rotations import (
    quaternion_from_matrix,
    quaternion_matrix,
    quaternion_multiply,
    quaternion_slerp,
)
from tf_transformations.vectors import Array, unit_vector, vector_norm

__all__ = [
    'Arcball',
    'arcball_constrain_to_axis',
    'arcball_map_to_sphere',
    'arcball_nearest_axis',
]

_NEARLY_ZERO = 1e-12


class Arcball:
    """
    A trackball, at first around the origin of the window and with the radius 1.

    Parameters
    ----------
    initial
        The first rotation: a quaternion (x, y, z, w) or a matrix (4, 4); none by default.

    """

    def __init__(self, initial: ArrayLike | None = None) -> None:
        start = np.array([0.0, 0.0, 0.0, 1.0] if initial is None else initial, float)
        if start.shape == (4, 4):
            start = quaternion_from_matrix(start)
        if start.shape != (4,):
            raise ValueError('The initial rotation must be a quaternion or a 4x4 matrix')
        self._now = self._before = self._at_down = unit_vector(start)
        self._down = np.array([0.0, 0.0, 1.0])
        self._axes: list[Array] = []
        self._axis: Array | None = None
        self._is_constrained = False
        self.place((0.0, 0.0), 1.0)

    def place(self, center: ArrayLike, radius: float) -> None:
        """
        Place the trackball in the window.

        Parameters
        ----------
        center
            The coordinates (x, y) of its centre; y is downwards.
        radius
            Its radius.

        """
        self._center, self._radius = np.asarray(center, float)[:2], float(radius)

    def setaxes(self, *axes: ArrayLike) -> None:
        """
        Set the axes that rotations can be constrained to.

        Parameters
        ----------
        *axes
            Directions (x, y, z); none for free rotations.

        """
        self._axes = [unit_vector(axis) for axis in axes]

    def setconstrain(self, constrain: bool) -> None:
        """
        Set whether rotations are constrained to the axes.

        Parameters
        ----------
        constrain
            Whether they are, from the next `down` on.

        """
        self._is_constrained = bool(constrain)

    def getconstrain(self) -> bool:
        """Return whether rotations are constrained to the axes."""
        return self._is_constrained

    def down(self, point: ArrayLike) -> None:
        """
        Begin to drag.

        Parameters
        ----------
        point
            The coordinates (x, y) of the pointer.

        """
        self._down = arcball_map_to_sphere(point, self._center, self._radius)
        self._at_down = self._before = self._now
        self._axis = None
        if self._is_constrained and self._axes:
            self._axis = arcball_nearest_axis(self._down, self._axes)
            self._down = arcball_constrain_to_axis(self._down, self._axis)

    def drag(self, point: ArrayLike) -> None:
        """
        Turn the object to where the pointer is now.

        Parameters
        ----------
        point
            The coordinates (x, y) of the pointer.

        """
        here = arcball_map_to_sphere(point, self._center, self._radius)
        if self._axis is not None:
            here = arcball_constrain_to_axis(here, self._axis)
        self._before = self._now
        across = np.cross(self._down, here)
        if across @ across < _NEARLY_ZERO:
            self._now = self._at_down
            return
        turn = np.append(across, self._down @ here)
        self._now = unit_vector(quaternion_multiply(turn, self._at_down))

    def next(self, acceleration: float = 0.0) -> None:
        """
        Go on to turn as with the last `drag`.

        Parameters
        ----------
        acceleration
            By which share of it the turn is larger.

        """
        turned = quaternion_slerp(self._before, self._now, 2.0 + acceleration, shortestpath=False)
        self._before, self._now = self._now, turned

    def matrix(self) -> Array:
        """Return the rotation as a homogeneous matrix (4, 4)."""
        return quaternion_matrix(self._now)


def arcball_map_to_sphere(point: ArrayLike, center: ArrayLike, radius: float) -> Array:
    """
    Compute the point of the trackball under the pointer.

    Parameters
    ----------
    point, center
        The coordinates (x, y) of the pointer and of the centre in the window; y is downwards.
    radius
        The radius of the trackball.

    Returns
    -------
    numpy.ndarray
        The point (x, y, z) of the unit sphere, with z towards the user; beside the trackball, the
        nearest point of its outline.

    """
    x, y = (np.asarray(point, float)[:2] - np.asarray(center, float)[:2]) / radius
    square = x * x + y * y
    if square > 1.0:
        return unit_vector([x, -y, 0.0])
    return np.array([x, -y, np.sqrt(1.0 - square)])


def arcball_constrain_to_axis(point: ArrayLike, axis: ArrayLike) -> Array:
    """
    Compute the nearest point of the sphere that is perpendicular to an axis.

    Parameters
    ----------
    point, axis
        The point of the unit sphere and the axis (x, y, z), of the length 1.

    Returns
    -------
    numpy.ndarray
        The point (x, y, z), on the side of the user.

    """
    here, along = np.asarray(point, float), np.asarray(axis, float)
    across = here - along * (along @ here)
    if vector_norm(across) > _NEARLY_ZERO:
        return unit_vector(-across if across[2] < 0.0 else across)
    if abs(along[2]) > 1.0 - _NEARLY_ZERO:
        return np.array([1.0, 0.0, 0.0])
    return unit_vector([-along[1], along[0], 0.0])


def arcball_nearest_axis(point: ArrayLike, axes: Sequence[ArrayLike]) -> Array:
    """
    Choose the axis whose great circle is nearest to a point.

    Parameters
    ----------
    point
        The point of the unit sphere.
    axes
        The axes (x, y, z), of the length 1; at least one.

    """
    here = np.asarray(point, float)
    return np.asarray(
        max(axes, key=lambda axis: float(arcball_constrain_to_axis(here, axis) @ here)), float
    )
