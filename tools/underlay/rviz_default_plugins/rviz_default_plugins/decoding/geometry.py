# SPDX-License-Identifier: Apache-2.0
"""Validation and conversion of positions and rotations in messages."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = [
    'FARTHEST',
    'Points',
    'Quaternion',
    'Triple',
    'along_x',
    'finite_points_of',
    'from_axes',
    'joined',
    'matrices_of',
    'points_of',
    'position',
    'rotated',
    'rotation',
    'rotations_of',
]

FARTHEST = 1e9
"""The distance in m beyond which nothing is drawn; browsers compute in 32 bits."""

Points = NDArray[np.float32]
Quaternion = tuple[float, float, float, float]
Triple = tuple[float, float, float]


def position(vector: Any, what: str = 'position') -> Triple:
    """
    Validate the coordinates of a point or vector.

    Parameters
    ----------
    vector
        A message with `x`, `y` and `z`, in m or in the unit of the vector.
    what
        Its name in the error message.

    Raises
    ------
    ValueError
        A coordinate is not finite, or its magnitude is above `FARTHEST`.

    """
    triple = (float(vector.x), float(vector.y), float(vector.z))
    if not all(abs(part) <= FARTHEST for part in triple):
        raise ValueError(f'its {what} is {_listed(triple)}, which is out of range.')
    return triple


def rotation(quaternion: Any, what: str = 'orientation') -> Quaternion:
    """
    Validate and normalise a quaternion.

    Parameters
    ----------
    quaternion
        A message with `x`, `y`, `z` and `w`.
    what
        Its name in the error message.

    Returns
    -------
    Quaternion
        w, x, y and z, of length 1.

    Raises
    ------
    ValueError
        The quaternion is not finite, or has zero length.

    """
    parts = (quaternion.w, quaternion.x, quaternion.y, quaternion.z)
    length = math.sqrt(sum(part * part for part in parts))
    if not math.isfinite(length):
        raise ValueError(f'its {what} has numbers that are not finite.')
    if length < 1e-6:
        raise ValueError(f'its {what} is a quaternion of zeros; the identity is w=1.')
    w, x, y, z = (float(part / length) for part in parts)
    return w, x, y, z


def points_of(points: Iterable[Any]) -> Points:
    """
    Convert the points of a message to an array.

    Parameters
    ----------
    points
        N messages with `x`, `y` and `z`, in m.

    Returns
    -------
    Points
        Rows x, y and z (N, 3); a coordinate beyond `FARTHEST` becomes infinite.

    """
    flat = [part for point in points for part in (point.x, point.y, point.z)]
    rows = np.array(flat, dtype=np.float64).reshape(-1, 3)
    rows[np.abs(rows) > FARTHEST] = np.inf
    return rows.astype(np.float32)


def finite_points_of(points: Iterable[Any]) -> Points:
    """
    Convert the points of a message to an array, and validate them.

    Parameters
    ----------
    points
        N messages with `x`, `y` and `z`, in m.

    Returns
    -------
    Points
        Rows x, y and z (N, 3).

    Raises
    ------
    ValueError
        A coordinate is not finite, or its magnitude is above `FARTHEST`.

    """
    rows = points_of(points)
    if lost := int((~np.isfinite(rows).all(axis=1)).sum()):
        raise ValueError(
            f'{lost} of its {len(rows)} points are not valid: their coordinates are not '
            'finite, or too large.'
        )
    return rows


def rotations_of(quaternions: Iterable[Any]) -> tuple[Points, NDArray[np.bool_]]:
    """
    Convert the quaternions of a message to an array, normalised.

    Parameters
    ----------
    quaternions
        N messages with `x`, `y`, `z` and `w`.

    Returns
    -------
    tuple[Points, NDArray[np.bool_]]
        Rows w, x, y and z (N, 4), the identity for invalid ones; and which are valid (N,).

    """
    flat = [part for each in quaternions for part in (each.w, each.x, each.y, each.z)]
    rows = np.array(flat, dtype=np.float64).reshape(-1, 4)
    with np.errstate(over='ignore'):
        lengths = np.linalg.norm(rows, axis=1)
    valid = np.isfinite(lengths) & (lengths >= 1e-6)
    rows[~valid] = (1.0, 0.0, 0.0, 0.0)
    lengths[~valid] = 1.0
    return (rows / lengths[:, None]).astype(np.float32), valid


def rotated(points: NDArray[Any], by: Sequence[float]) -> NDArray[Any]:
    """
    Rotate points by a quaternion.

    Parameters
    ----------
    points
        Rows x, y and z (N, 3), as floating-point numbers.
    by
        The rotation as w, x, y and z, of length 1.

    Returns
    -------
    NDArray[Any]
        The rotated rows (N, 3).

    """
    matrix = matrices_of(np.array([by]))[0].astype(points.dtype)
    turned: NDArray[Any] = points @ matrix.T
    return turned


def matrices_of(wxyzs: NDArray[Any]) -> NDArray[Any]:
    """
    Convert quaternions to rotation matrices.

    Parameters
    ----------
    wxyzs
        Rows w, x, y and z (N, 4), of length 1.

    Returns
    -------
    NDArray[Any]
        The matrices (N, 3, 3), which have the axes as columns.

    """
    w, x, y, z = wxyzs.T
    parts = [
        1.0 - 2.0 * (y * y + z * z),
        2.0 * (x * y - w * z),
        2.0 * (x * z + w * y),
        2.0 * (x * y + w * z),
        1.0 - 2.0 * (x * x + z * z),
        2.0 * (y * z - w * x),
        2.0 * (x * z - w * y),
        2.0 * (y * z + w * x),
        1.0 - 2.0 * (x * x + y * y),
    ]
    return np.stack(parts, axis=1).reshape(-1, 3, 3)


def joined(first: Sequence[float], then: Sequence[float]) -> Quaternion:
    """
    Multiply two quaternions.

    Parameters
    ----------
    first, then
        Each w, x, y and z; `then` is expressed in the frame that `first` gives.

    Returns
    -------
    Quaternion
        The product `first` times `then`, as w, x, y and z.

    """
    (a, b, c, d), (e, f, g, h) = first, then
    return (
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    )


def along_x(direction: Sequence[float]) -> Quaternion:
    """
    Find the shortest rotation that turns the x axis into a direction.

    Parameters
    ----------
    direction
        The direction (3,), of any length but zero.

    Returns
    -------
    Quaternion
        w, x, y and z, of length 1.

    """
    x, y, z = np.asarray(direction, dtype=float) / np.linalg.norm(direction)
    w = 1.0 + x
    if w < 1e-9:
        return 0.0, 0.0, 0.0, 1.0
    length = math.sqrt(w * w + y * y + z * z)
    return float(w / length), 0.0, float(-z / length), float(y / length)


def from_axes(axes: NDArray[Any]) -> Quaternion:
    """
    Convert a rotation matrix to a quaternion.

    Parameters
    ----------
    axes
        The matrix (3, 3), with the axes as columns.

    Returns
    -------
    Quaternion
        w, x, y and z, of length 1.

    """
    # The quaternion is the eigenvector of the largest eigenvalue of this symmetric matrix.
    (a, b, c), (d, e, f), (g, h, i) = np.asarray(axes, dtype=float)
    symmetric = np.array(
        [
            [a + e + i, h - f, c - g, d - b],
            [h - f, a - e - i, b + d, c + g],
            [c - g, b + d, e - a - i, f + h],
            [d - b, c + g, f + h, i - a - e],
        ]
    )
    w, x, y, z = np.linalg.eigh(symmetric)[1][:, -1]
    return float(w), float(x), float(y), float(z)


def _listed(parts: Iterable[float]) -> str:
    return ', '.join(f'{part:g}' for part in parts)
