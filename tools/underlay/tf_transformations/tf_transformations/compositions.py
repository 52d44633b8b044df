# SPDX-License-Identifier: Apache-2.0
"""What a homogeneous matrix consists of, and which one maps points to others."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from tf_transformations.rotations import euler_from_matrix, euler_matrix
from tf_transformations.vectors import Array

__all__ = ['compose_matrix', 'decompose_matrix', 'superimposition_matrix']


def compose_matrix(
    scale: ArrayLike | None = None,
    shear: ArrayLike | None = None,
    angles: ArrayLike | None = None,
    translate: ArrayLike | None = None,
    perspective: ArrayLike | None = None,
) -> Array:
    """
    Compute the matrix that scales, shears, rotates, translates and projects, in this order.

    Parameters
    ----------
    scale
        The factors along x, y and z.
    shear
        The shears of x by y, of x by z and of y by z.
    angles
        Roll, pitch and yaw, in rad.
    translate
        The translation (x, y, z).
    perspective
        The last row of the projection.

    Returns
    -------
    numpy.ndarray
        The homogeneous matrix (4, 4).

    """
    matrix = np.eye(4)
    if angles is not None:
        roll, pitch, yaw = np.asarray(angles, float)
        matrix = euler_matrix(roll, pitch, yaw)
    if translate is not None:
        matrix[:3, 3] = np.asarray(translate, float)[:3]
    if shear is not None:
        sheared = np.eye(4)
        sheared[0, 1], sheared[0, 2], sheared[1, 2] = np.asarray(shear, float)
        matrix = matrix @ sheared
    if scale is not None:
        matrix = matrix @ np.diag([*np.asarray(scale, float), 1.0])
    if perspective is not None:
        projection = np.eye(4)
        projection[3] = np.asarray(perspective, float)
        matrix = projection @ matrix
    composed: Array = matrix / matrix[3, 3]
    return composed


def decompose_matrix(matrix: ArrayLike) -> tuple[Array, Array, tuple[float, ...], Array, Array]:
    """
    Compute what a matrix consists of.

    Parameters
    ----------
    matrix
        The homogeneous matrix (4, 4).

    Returns
    -------
    tuple
        Scale, shear, angles, translation and perspective, as for `compose_matrix`.

    Raises
    ------
    ValueError
        The matrix has no inverse.

    """
    whole = np.array(matrix, float)
    if abs(whole[3, 3]) < 1e-12:
        raise ValueError('The last number of a homogeneous matrix must not be 0')
    whole /= whole[3, 3]
    affine = np.vstack([whole[:3], (0.0, 0.0, 0.0, 1.0)])
    if abs(np.linalg.det(affine)) < 1e-12:
        raise ValueError('Only a matrix that has an inverse can be decomposed')
    rotation, upper = np.linalg.qr(affine[:3, :3])
    signs = np.where(np.diag(upper) < 0.0, -1.0, 1.0)
    rotation, upper = rotation * signs, upper * signs[:, None]
    if np.linalg.det(rotation) < 0.0:
        rotation, upper = -rotation, -upper
    scale = np.diag(upper).copy()
    sheared = upper / scale
    shear = np.array([sheared[0, 1], sheared[0, 2], sheared[1, 2]])
    perspective = whole[3] @ np.linalg.inv(affine)
    return scale, shear, euler_from_matrix(rotation), affine[:3, 3].copy(), perspective


def superimposition_matrix(
    v0: ArrayLike, v1: ArrayLike, scaling: bool = False, usesvd: bool = True
) -> Array:
    """
    Compute the motion that brings points onto others, with the least squares of the distances.

    Parameters
    ----------
    v0, v1
        The points and where they are to be, of shape (3, N).
    scaling
        Whether the points may also be scaled, by one factor.
    usesvd
        Has no effect: both algorithms that it chooses between have the same result.

    Returns
    -------
    numpy.ndarray
        The homogeneous matrix (4, 4).

    """
    here, there = np.asarray(v0, float)[:3], np.asarray(v1, float)[:3]
    here_mean, there_mean = here.mean(axis=1), there.mean(axis=1)
    here, there = here - here_mean[:, None], there - there_mean[:, None]
    left, _, right = np.linalg.svd(there @ here.T)
    signs = np.array([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    linear = (left * signs) @ right
    if scaling:
        linear *= np.sqrt(np.sum(there**2) / np.sum(here**2))
    matrix = np.eye(4)
    matrix[:3, :3] = linear
    matrix[:3, 3] = there_mean - linear @ here_mean
    return matrix
