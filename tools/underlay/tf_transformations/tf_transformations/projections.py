# SPDX-License-Identifier: Apache-2.0
"""Homogeneous matrices (4, 4) that project onto planes, clip volumes, and of crystal cells."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike
from tf_transformations.matrices import fixed_point
from tf_transformations.vectors import Array, unit_vector

__all__ = [
    'clip_matrix',
    'orthogonalization_matrix',
    'projection_from_matrix',
    'projection_matrix',
]


def projection_matrix(
    point: ArrayLike,
    normal: ArrayLike,
    direction: ArrayLike | None = None,
    perspective: ArrayLike | None = None,
    pseudo: bool = False,
) -> Array:
    """
    Compute the matrix of a projection onto a plane.

    Parameters
    ----------
    point
        A point (x, y, z) of the plane.
    normal
        The direction that is perpendicular to the plane.
    direction
        The direction of a parallel projection; by default the normal.
    perspective
        The centre (x, y, z) of a central projection; it replaces the direction.
    pseudo
        Whether a central projection keeps the depth: projected along the normal, its result is
        that of the central projection.

    Returns
    -------
    numpy.ndarray
        The homogeneous matrix (4, 4).

    """
    across = unit_vector(np.asarray(normal, float)[:3])
    offset = float(np.asarray(point, float)[:3] @ across)
    matrix = np.eye(4)
    if perspective is not None:
        centre = np.asarray(perspective, float)[:3]
        matrix[:3, :3] = (centre @ across - offset) * np.eye(3) - np.outer(centre, across)
        matrix[:3, 3] = offset * centre
        if pseudo:
            matrix[:3, :3] -= np.outer(across, across)
            matrix[:3, 3] += offset * across
        matrix[3] = (*-across, centre @ across)
        return matrix
    along = across if direction is None else np.asarray(direction, float)[:3]
    scale = float(along @ across)
    matrix[:3, :3] -= np.outer(along, across) / scale
    matrix[:3, 3] = offset * along / scale
    return matrix


def projection_from_matrix(
    matrix: ArrayLike, pseudo: bool = False
) -> tuple[Array, Array, Array | None, Array | None, bool]:
    """
    Compute the plane of a projection, and its direction or centre.

    Parameters
    ----------
    matrix
        The homogeneous matrix (4, 4) of a projection.
    pseudo
        Whether it is a central projection that keeps the depth.

    Returns
    -------
    tuple
        The arguments of `projection_matrix`: a point of the plane (x, y, z, 1), its normal, the
        direction, or None for a central projection, the centre, or None for a parallel one, and
        whether it keeps the depth.

    Raises
    ------
    ValueError
        The matrix is no projection.

    """
    numbers = np.array(matrix, float)
    length = float(np.linalg.norm(numbers[3, :3]))
    if length < 1e-9:
        return _parallel(numbers / numbers[3, 3])
    numbers /= length
    normal, linear = -numbers[3, :3], numbers[:3, :3].copy()
    if pseudo:
        linear += np.outer(normal, normal)
    # The rest is s I - centre normal^T, where s is the distance of the centre from the plane.
    distance = (float(np.trace(linear)) + numbers[3, 3]) / 3.0
    centre = distance * normal - linear @ normal
    plane = (numbers[3, 3] - distance) * normal
    return np.append(plane, 1.0), normal, None, centre, pseudo


def _parallel(matrix: Array) -> tuple[Array, Array, Array | None, Array | None, bool]:
    """Compute the plane and the direction of a parallel projection."""
    left, sizes, right = np.linalg.svd(matrix[:3, :3])
    if sizes[-1] > 1e-8:
        raise ValueError('The matrix is not a projection: it has an inverse')
    # It takes away the direction, and nothing that it leaves is along the normal.
    return fixed_point(matrix), left[:, -1], right[-1], None, False


def clip_matrix(
    left: float,
    right: float,
    bottom: float,
    top: float,
    near: float,
    far: float,
    perspective: bool = False,
) -> Array:
    """
    Compute the matrix that maps a volume to the cube from -1 to 1.

    Parameters
    ----------
    left, right, bottom, top, near, far
        The bounds along x, y and z.
    perspective
        Whether the volume is a truncated pyramid, whose apex is the origin and whose face at
        `near` has the bounds, instead of a box. The results are to be divided by their last
        number.

    Returns
    -------
    numpy.ndarray
        The homogeneous matrix (4, 4).

    Raises
    ------
    ValueError
        The bounds are not in order, or the pyramid does not begin in front of its apex.

    """
    if left >= right or bottom >= top or near >= far:
        raise ValueError('The bounds of the volume must be left < right, bottom < top, near < far')
    low, high = np.array([left, bottom, near], float), np.array([right, top, far], float)
    matrix = np.zeros((4, 4))
    if not perspective:
        matrix[:3, :3] = np.diag(2.0 / (high - low))
        matrix[:, 3] = (*-(high + low) / (high - low), 1.0)
        return matrix
    if near <= 0.0:
        raise ValueError('The pyramid must begin at near > 0, in front of its apex')
    matrix[[0, 1], [0, 1]] = 2.0 * near / (high - low)[:2]
    matrix[:2, 2] = -((high + low) / (high - low))[:2]
    matrix[2, 2:] = (far + near) / (far - near), -2.0 * far * near / (far - near)
    matrix[3, 2] = 1.0
    return matrix


def orthogonalization_matrix(lengths: ArrayLike, angles: ArrayLike) -> Array:
    """
    Compute the matrix from the coordinates of a crystal cell to orthogonal ones.

    Parameters
    ----------
    lengths
        The lengths of the edges a, b and c.
    angles
        The angles between b and c, a and c, and a and b, in degrees.

    Returns
    -------
    numpy.ndarray
        The homogeneous matrix (4, 4): c is along z, and b in the plane of y and z.

    """
    a, b, c = np.asarray(lengths, float)
    alpha, beta, gamma = np.radians(np.asarray(angles, float))
    across = a * (math.cos(gamma) - math.cos(alpha) * math.cos(beta)) / math.sin(alpha)
    matrix = np.eye(4)
    matrix[:3, 0] = (
        math.sqrt((a * math.sin(beta)) ** 2 - across**2),
        across,
        a * math.cos(beta),
    )
    matrix[1:3, 1] = b * math.sin(alpha), b * math.cos(alpha)
    matrix[2, 2] = c
    return matrix
