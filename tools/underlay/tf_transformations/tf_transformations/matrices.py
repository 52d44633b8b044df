# SPDX-License-Identifier: Apache-2.0
"""Homogeneous matrices (4, 4) of translations, rotations, reflections, scales and shears."""

from __future__ import annotations

import functools
import math

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation
from tf_transformations.vectors import Array, unit_vector

__all__ = [
    'concatenate_matrices',
    'fixed_point',
    'identity_matrix',
    'inverse_matrix',
    'is_same_transform',
    'reflection_from_matrix',
    'reflection_matrix',
    'rotation_from_matrix',
    'rotation_matrix',
    'scale_from_matrix',
    'scale_matrix',
    'shear_from_matrix',
    'shear_matrix',
    'translation_from_matrix',
    'translation_matrix',
]


def identity_matrix() -> Array:
    """Return the matrix that changes nothing."""
    return np.eye(4)


def translation_matrix(direction: ArrayLike) -> Array:
    """
    Compute the matrix of a translation.

    Parameters
    ----------
    direction
        The translation (x, y, z).

    """
    matrix = np.eye(4)
    matrix[:3, 3] = np.asarray(direction, float)[:3]
    return matrix


def translation_from_matrix(matrix: ArrayLike) -> Array:
    """
    Return the translation of a matrix.

    Parameters
    ----------
    matrix
        The homogeneous matrix.

    """
    return np.array(matrix, float)[:3, 3]


def rotation_matrix(angle: float, direction: ArrayLike, point: ArrayLike | None = None) -> Array:
    """
    Compute the matrix of a turn about an axis.

    Parameters
    ----------
    angle
        The angle of the turn, in rad.
    direction
        The direction (x, y, z) of the axis.
    point
        A point of the axis; the origin by default.

    """
    linear = Rotation.from_rotvec(angle * unit_vector(np.asarray(direction, float)[:3]))
    return _about(linear.as_matrix(), point)


def rotation_from_matrix(matrix: ArrayLike) -> tuple[float, Array, Array]:
    """
    Compute the axis of a turn.

    Parameters
    ----------
    matrix
        The homogeneous matrix of a rotation, as from `rotation_matrix`.

    Returns
    -------
    tuple
        The angle in [0, pi], the direction (x, y, z), and a point (x, y, z, 1) of the axis.

    """
    numbers = np.asarray(matrix, float)
    turn = Rotation.from_matrix(numbers[:3, :3]).as_rotvec()
    angle = float(np.linalg.norm(turn))
    direction = turn / angle if angle else np.array([0.0, 0.0, 1.0])
    return angle, direction, fixed_point(numbers)


def reflection_matrix(point: ArrayLike, normal: ArrayLike) -> Array:
    """
    Compute the matrix of a mirror.

    Parameters
    ----------
    point
        A point of the mirror (x, y, z).
    normal
        The direction that is perpendicular to it.

    """
    across = unit_vector(np.asarray(normal, float)[:3])
    return _about(np.eye(3) - 2.0 * np.outer(across, across), point)


def reflection_from_matrix(matrix: ArrayLike) -> tuple[Array, Array]:
    """
    Compute the plane of a mirror.

    Parameters
    ----------
    matrix
        The homogeneous matrix of a reflection.

    Returns
    -------
    tuple
        A point (x, y, z, 1) of the mirror, and its normal (x, y, z).

    Raises
    ------
    ValueError
        The matrix is no reflection.

    """
    numbers = np.asarray(matrix, float)
    normal = _eigenvector(numbers[:3, :3], -1.0)
    if normal is None:
        raise ValueError('The matrix is not a reflection: it reverses no direction')
    return fixed_point(numbers), normal


def scale_matrix(
    factor: float, origin: ArrayLike | None = None, direction: ArrayLike | None = None
) -> Array:
    """
    Compute the matrix of a scale.

    Parameters
    ----------
    factor
        The factor; -1 turns all directions round.
    origin
        The point that stays where it is; the origin by default.
    direction
        The only direction that is scaled; all by default.

    """
    if direction is None:
        return _about(factor * np.eye(3), origin)
    along = unit_vector(np.asarray(direction, float)[:3])
    return _about(np.eye(3) + (factor - 1.0) * np.outer(along, along), origin)


def scale_from_matrix(matrix: ArrayLike) -> tuple[float, Array, Array | None]:
    """
    Compute the factor of a scale.

    Parameters
    ----------
    matrix
        The homogeneous matrix of a scale.

    Returns
    -------
    tuple
        The factor, the point (x, y, z, 1) that stays where it is, and the direction that is
        scaled; None for all.

    Raises
    ------
    ValueError
        The matrix is no scale.

    """
    numbers = np.asarray(matrix, float)
    linear = numbers[:3, :3]
    factor = float(np.trace(linear)) - 2.0
    direction = _eigenvector(linear, factor)
    if direction is not None:
        along = np.eye(3) + (factor - 1.0) * np.outer(direction, direction)
        if np.allclose(linear, along):
            return factor, fixed_point(numbers), direction
    factor = float(np.trace(linear)) / 3.0
    if not np.allclose(linear, factor * np.eye(3)):
        raise ValueError('The matrix is not a uniform scaling: use decompose_matrix')
    return factor, fixed_point(numbers), None


def shear_matrix(angle: float, direction: ArrayLike, point: ArrayLike, normal: ArrayLike) -> Array:
    """
    Compute the matrix of a shear.

    Parameters
    ----------
    angle
        How far what is perpendicular to the plane is tilted, in rad.
    direction
        The direction of the shear, in the plane.
    point
        A point of the plane that stays.
    normal
        The direction that is perpendicular to the plane.

    Raises
    ------
    ValueError
        The direction is not in the plane.

    """
    across = unit_vector(np.asarray(normal, float)[:3])
    along = unit_vector(np.asarray(direction, float)[:3])
    if abs(across @ along) > 1e-6:
        raise ValueError('A shear has a direction that is perpendicular to the normal')
    return _about(np.eye(3) + math.tan(angle) * np.outer(along, across), point)


def shear_from_matrix(matrix: ArrayLike) -> tuple[float, Array, Array, Array]:
    """
    Compute the plane and the angle of a shear.

    Parameters
    ----------
    matrix
        The homogeneous matrix (4, 4) of a shear.

    Returns
    -------
    tuple
        The arguments of `shear_matrix`: the angle in rad, the direction, a point (x, y, z, 1) of
        the plane, and its normal.

    Raises
    ------
    ValueError
        The matrix is no shear.

    """
    numbers = np.asarray(matrix, float)
    left, sizes, right = np.linalg.svd(numbers[:3, :3] - np.eye(3))
    along, across = left[:, 0], right[0]
    if sizes[0] < 1e-9 or sizes[1] > 1e-6 or abs(along @ across) > 1e-6:
        raise ValueError('The matrix is not a shear: it does not move points along one plane')
    return math.atan(sizes[0]), along, fixed_point(numbers), across


def inverse_matrix(matrix: ArrayLike) -> Array:
    """
    Compute the inverse of a matrix.

    Parameters
    ----------
    matrix
        Any square matrix that has an inverse.

    """
    return np.linalg.inv(np.asarray(matrix, float))


def concatenate_matrices(*matrices: ArrayLike) -> Array:
    """
    Multiply homogeneous matrices; the last one comes first.

    Parameters
    ----------
    *matrices
        The matrices (4, 4).

    """
    return functools.reduce(np.matmul, (np.asarray(each, float) for each in matrices), np.eye(4))


def is_same_transform(matrix0: ArrayLike, matrix1: ArrayLike) -> bool:
    """
    Whether two homogeneous matrices move points in the same way.

    Parameters
    ----------
    matrix0, matrix1
        The matrices (4, 4).

    """
    one, other = np.asarray(matrix0, float), np.asarray(matrix1, float)
    return bool(np.allclose(one / one[3, 3], other / other[3, 3]))


def _about(linear: Array, point: ArrayLike | None) -> Array:
    """Return the homogeneous matrix of a linear map that leaves a point where it is."""
    matrix = np.eye(4)
    matrix[:3, :3] = linear
    if point is not None:
        place = np.asarray(point, float)[:3]
        matrix[:3, 3] = place - linear @ place
    return matrix


def fixed_point(matrix: Array) -> Array:
    """
    Return the point (x, y, z, 1), close to the origin, that a matrix leaves where it is.

    Parameters
    ----------
    matrix
        The homogeneous matrix (4, 4), whose last row is (0, 0, 0, 1).

    """
    place, *_ = np.linalg.lstsq(np.eye(3) - matrix[:3, :3], matrix[:3, 3], rcond=1e-9)
    return np.append(place, 1.0)


def _eigenvector(linear: Array, value: float) -> Array | None:
    values, vectors = np.linalg.eig(linear)
    near = np.flatnonzero(np.abs(values - value) < 1e-8)
    return np.real(vectors[:, near[0]]) if len(near) else None
