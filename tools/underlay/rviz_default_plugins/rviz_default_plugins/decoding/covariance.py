# SPDX-License-Identifier: Apache-2.0
"""The covariance of a position as an ellipsoid."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from rviz_default_plugins.decoding.geometry import FARTHEST, from_axes, Quaternion, Triple

__all__ = ['Ellipsoid', 'ellipsoid_of']


class Ellipsoid(NamedTuple):
    """The semi-axes of an ellipsoid in metres, and its rotation."""

    radii: Triple
    wxyz: Quaternion


def ellipsoid_of(covariance: Any) -> Ellipsoid:
    """
    Compute the ellipsoid of one standard deviation of a position.

    Parameters
    ----------
    covariance
        The covariance of a pose: 36 numbers, row-major; those of x, y and z (m^2) are used.

    Raises
    ------
    ValueError
        The numbers are not finite, far too large, or not a valid covariance.

    """
    block = np.asarray(covariance, dtype=float).reshape(6, 6)[:3, :3]
    if not (np.abs(block) <= FARTHEST**2).all():
        raise ValueError('its covariance has numbers that are not finite, or far too large.')
    variances, axes = np.linalg.eigh((block + block.T) / 2.0)
    if variances[0] < -1e-9 * max(1.0, variances[-1]):
        raise ValueError('its covariance is none: the variance in some direction is negative.')
    if np.linalg.det(axes) < 0.0:
        axes[:, 0] = -axes[:, 0]
    x, y, z = np.sqrt(np.maximum(variances, 0.0))
    return Ellipsoid((float(x), float(y), float(z)), from_axes(axes))
