# SPDX-License-Identifier: Apache-2.0
"""Rotations as Euler angles, quaternions (x, y, z, w) and homogeneous matrices."""

from __future__ import annotations

import math
import warnings

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation
from tf_transformations.vectors import Array, unit_vector

__all__ = [
    'euler_from_matrix',
    'euler_from_quaternion',
    'euler_matrix',
    'quaternion_about_axis',
    'quaternion_conjugate',
    'quaternion_from_euler',
    'quaternion_from_matrix',
    'quaternion_inverse',
    'quaternion_matrix',
    'quaternion_multiply',
    'quaternion_slerp',
    'random_quaternion',
    'random_rotation_matrix',
]

Axes = str | tuple[int, int, int, int]
_NEARLY_ZERO = 1e-12


def _sequence(axes: Axes) -> str:
    """Return how SciPy names axes such as 'sxyz' or (0, 0, 0, 0): upper case if they rotate."""
    if not isinstance(axes, str):
        first, odd, repeated, rotating = axes
        second, third = ((first + 1 + odd) % 3, (first + 2 - odd) % 3)
        order = [first, second, first if repeated else third]
        axes = 'r' * rotating + 's' * (not rotating)
        axes += ''.join('xyz'[each] for each in (order[::-1] if rotating else order))
    kind, names = axes[:1].lower(), axes[1:].lower()
    pairs_differ = len(names) == 3 and names[0] != names[1] != names[2]
    if kind not in ('s', 'r') or not pairs_differ or set(names) - set('xyz'):
        raise ValueError(
            f"'{axes}' are not axes of Euler angles: use s for static or r for rotating axes and "
            'three of x, y and z, such as sxyz, rzyx or szxz'
        )
    return names.upper() if kind == 'r' else names


def _rotation(quaternion: ArrayLike) -> Rotation:
    """Return a rotation; that of a quaternion without length is none."""
    numbers = np.asarray(quaternion, float)
    return Rotation.from_quat(numbers) if numbers @ numbers > _NEARLY_ZERO else Rotation.identity()


def _homogeneous(rotation: Rotation) -> Array:
    matrix = np.eye(4)
    matrix[:3, :3] = rotation.as_matrix()
    return matrix


def _angles(rotation: Rotation, axes: Axes) -> tuple[float, float, float]:
    with warnings.catch_warnings():
        warnings.simplefilter('ignore', UserWarning)  # of several solutions one is as good
        first, second, third = rotation.as_euler(_sequence(axes)).tolist()
    return first, second, third


def euler_matrix(ai: float, aj: float, ak: float, axes: Axes = 'sxyz') -> Array:
    """
    Compute the matrix of Euler angles.

    Parameters
    ----------
    ai, aj, ak
        The angles about the three axes, in their order; roll, pitch and yaw by default.
    axes
        The axes: s for static or r for rotating ones, and three of x, y and z.

    Returns
    -------
    numpy.ndarray
        The homogeneous matrix (4, 4).

    Raises
    ------
    ValueError
        There are no such axes.

    """
    return _homogeneous(Rotation.from_euler(_sequence(axes), (ai, aj, ak)))


def euler_from_matrix(matrix: ArrayLike, axes: Axes = 'sxyz') -> tuple[float, float, float]:
    """
    Compute the Euler angles of a rotation.

    Parameters
    ----------
    matrix
        The matrix (3, 3) or (4, 4), of which only the rotation is used.
    axes
        The axes, as in `euler_matrix`.

    Returns
    -------
    tuple
        The angles about the three axes. Where only the sum of the first and the third matters, the
        third is 0.

    Raises
    ------
    ValueError
        There are no such axes, or the matrix is no rotation.

    """
    return _angles(Rotation.from_matrix(np.asarray(matrix, float)[:3, :3]), axes)


def euler_from_quaternion(
    quaternion: ArrayLike, axes: Axes = 'sxyz'
) -> tuple[float, float, float]:
    """
    Compute the Euler angles of a quaternion.

    Parameters
    ----------
    quaternion
        (x, y, z, w), of any length.
    axes
        The axes, as in `euler_matrix`.

    Returns
    -------
    tuple
        The angles about the three axes, as from `euler_from_matrix`.

    Raises
    ------
    ValueError
        There are no such axes.

    """
    return _angles(_rotation(quaternion), axes)


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: Axes = 'sxyz') -> Array:
    """
    Compute the quaternion of Euler angles.

    Parameters
    ----------
    ai, aj, ak
        The angles about the three axes, in their order; roll, pitch and yaw by default.
    axes
        The axes, as in `euler_matrix`.

    Returns
    -------
    numpy.ndarray
        (x, y, z, w).

    Raises
    ------
    ValueError
        There are no such axes.

    """
    quaternion: Array = Rotation.from_euler(_sequence(axes), (ai, aj, ak)).as_quat()
    return quaternion


def quaternion_about_axis(angle: float, axis: ArrayLike) -> Array:
    """
    Compute the quaternion of a turn about an axis.

    Parameters
    ----------
    angle
        The angle of the turn.
    axis
        The axis (x, y, z), of any length but 0.

    Returns
    -------
    numpy.ndarray
        (x, y, z, w).

    """
    return np.append(math.sin(angle / 2.0) * unit_vector(axis), math.cos(angle / 2.0))


def quaternion_matrix(quaternion: ArrayLike) -> Array:
    """
    Compute the matrix of a quaternion.

    Parameters
    ----------
    quaternion
        (x, y, z, w), of any length.

    Returns
    -------
    numpy.ndarray
        The homogeneous matrix (4, 4).

    """
    return _homogeneous(_rotation(quaternion))


def quaternion_from_matrix(matrix: ArrayLike) -> Array:
    """
    Compute the quaternion of a rotation.

    Parameters
    ----------
    matrix
        The matrix (3, 3) or (4, 4), of which only the rotation is used.

    Returns
    -------
    numpy.ndarray
        (x, y, z, w), with w not negative.

    Raises
    ------
    ValueError
        The matrix is no rotation.

    """
    rotation = Rotation.from_matrix(np.asarray(matrix, float)[:3, :3])
    quaternion: Array = rotation.as_quat(canonical=True)
    return quaternion


def quaternion_multiply(quaternion1: ArrayLike, quaternion0: ArrayLike) -> Array:
    """
    Multiply quaternions: the rotation that does first the second and then the first one.

    Parameters
    ----------
    quaternion1, quaternion0
        (x, y, z, w).

    Returns
    -------
    numpy.ndarray
        Their product (x, y, z, w).

    """
    left, right = np.asarray(quaternion1, float), np.asarray(quaternion0, float)
    vector = left[3] * right[:3] + right[3] * left[:3] + np.cross(left[:3], right[:3])
    return np.append(vector, left[3] * right[3] - left[:3] @ right[:3])


def quaternion_conjugate(quaternion: ArrayLike) -> Array:
    """
    Compute the conjugate of a quaternion.

    Parameters
    ----------
    quaternion
        (x, y, z, w).

    """
    return np.asarray(quaternion, float) * (-1.0, -1.0, -1.0, 1.0)


def quaternion_inverse(quaternion: ArrayLike) -> Array:
    """
    Compute the inverse of a quaternion.

    Parameters
    ----------
    quaternion
        (x, y, z, w), of any length but 0.

    """
    numbers = np.asarray(quaternion, float)
    inverse: Array = quaternion_conjugate(numbers) / (numbers @ numbers)
    return inverse


def quaternion_slerp(
    quat0: ArrayLike,
    quat1: ArrayLike,
    fraction: float,
    spin: int = 0,
    shortestpath: bool = True,
) -> Array:
    """
    Interpolate between rotations, at a constant rate.

    Parameters
    ----------
    quat0, quat1
        The rotations at the fractions 0 and 1: (x, y, z, w).
    fraction
        Where to interpolate.
    spin
        How many more half turns there are on the way.
    shortestpath
        Whether to take the shorter of the two ways.

    Returns
    -------
    numpy.ndarray
        (x, y, z, w), of the length 1.

    """
    start, end = unit_vector(quat0), unit_vector(quat1)
    if shortestpath and start @ end < 0.0:
        end = -end
    angle = math.acos(float(np.clip(start @ end, -1.0, 1.0))) + spin * math.pi
    if abs(math.sin(angle)) < _NEARLY_ZERO:
        return end if fraction == 1.0 else start
    return (start * math.sin((1.0 - fraction) * angle) + end * math.sin(fraction * angle)) / (
        math.sin(angle)
    )


def random_quaternion(rand: ArrayLike | None = None) -> Array:
    """
    Draw a rotation; all are equally likely.

    Parameters
    ----------
    rand
        Three numbers from [0, 1) that determine it; drawn by default.

    Returns
    -------
    numpy.ndarray
        (x, y, z, w).

    """
    first, *turns = np.random.default_rng().random(3) if rand is None else np.asarray(rand, float)
    one, other = 2.0 * math.pi * turns[0], 2.0 * math.pi * turns[1]
    small, large = math.sqrt(1.0 - first), math.sqrt(first)
    return np.array(
        [
            math.sin(one) * small,
            math.cos(one) * small,
            math.sin(other) * large,
            math.cos(other) * large,
        ]
    )


def random_rotation_matrix(rand: ArrayLike | None = None) -> Array:
    """
    Draw a rotation; all are equally likely.

    Parameters
    ----------
    rand
        Three numbers from [0, 1) that determine it; drawn by default.

    Returns
    -------
    numpy.ndarray
        The homogeneous matrix (4, 4).

    """
    return quaternion_matrix(random_quaternion(rand))
