# SPDX-License-Identifier: Apache-2.0
"""
Pose arithmetic: composition, inversion and interpolation.

Implemented in plain Python, as chains are short: for 10 links, scipy's Rotation takes several
times as long even in batches (see tools/benchmarks/tf2_lookups.py), and 0.25 s to import. The
tests compare with scipy.
"""

from __future__ import annotations

from math import acos, isfinite, sin, sqrt

# x, y, z in metres, then the quaternion x, y, z, w.
Pose = tuple[float, float, float, float, float, float, float]

IDENTITY: Pose = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
# Above this cosine, linear interpolation keeps the norm within 2.5e-13 of 1.
_NEARLY_EQUAL = 1.0 - 1e-12
_NORM_TOLERANCE = 0.01


def chain(parent: Pose, child: Pose) -> Pose:
    """
    Compose two transforms.

    Parameters
    ----------
    parent
        Pose of a frame in its parent: x, y, z in m, quaternion x, y, z, w of length 1.
    child
        Pose of a child in that frame.

    Returns
    -------
    Pose
        Pose of the child in the parent.

    """
    px, py, pz, ax, ay, az, aw = parent
    x, y, z, bx, by, bz, bw = child
    tx = 2.0 * (ay * z - az * y)
    ty = 2.0 * (az * x - ax * z)
    tz = 2.0 * (ax * y - ay * x)
    return (
        px + x + aw * tx + ay * tz - az * ty,
        py + y + aw * ty + az * tx - ax * tz,
        pz + z + aw * tz + ax * ty - ay * tx,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def inverse(pose: Pose) -> Pose:
    """
    Invert a transform.

    Parameters
    ----------
    pose
        Pose of a child in its parent, with a quaternion of length 1.

    Returns
    -------
    Pose
        Pose of the parent in the child.

    """
    x, y, z, qx, qy, qz, qw = pose
    return chain((0.0, 0.0, 0.0, -qx, -qy, -qz, qw), (-x, -y, -z, 0.0, 0.0, 0.0, 1.0))


def interpolate(first: Pose, last: Pose, fraction: float) -> Pose:
    """
    Interpolate between two poses: linearly in translation, by slerp in rotation.

    The rotation follows the shorter arc.

    Parameters
    ----------
    first, last
        The poses, with quaternions of length 1.
    fraction
        The interpolation parameter, from 0 (first) to 1 (last).

    """
    x, y, z, ax, ay, az, aw = first
    lx, ly, lz, bx, by, bz, bw = last
    cosine = ax * bx + ay * by + az * bz + aw * bw
    near, far = _weights(abs(cosine), fraction)
    if cosine < 0.0:
        far = -far
    return (
        x + (lx - x) * fraction,
        y + (ly - y) * fraction,
        z + (lz - z) * fraction,
        ax * near + bx * far,
        ay * near + by * far,
        az * near + bz * far,
        aw * near + bw * far,
    )


def _weights(cosine: float, fraction: float) -> tuple[float, float]:
    if cosine > _NEARLY_EQUAL:
        return 1.0 - fraction, fraction
    angle = acos(cosine)
    sine = sin(angle)
    return sin((1.0 - fraction) * angle) / sine, sin(fraction * angle) / sine


def is_finite(pose: Pose) -> bool:
    """
    Check whether all numbers of a pose are finite.

    Parameters
    ----------
    pose
        Translation and quaternion.

    """
    return all(map(isfinite, pose))


def normalized(pose: Pose) -> Pose | None:
    """
    Normalize the quaternion of a pose.

    Parameters
    ----------
    pose
        Translation and quaternion x, y, z, w.

    Returns
    -------
    Pose or None
        None if the squared length of the quaternion is off by more than 0.01 from 1.

    """
    x, y, z, qx, qy, qz, qw = pose
    square = qx * qx + qy * qy + qz * qz + qw * qw
    if abs(square - 1.0) > _NORM_TOLERANCE:
        return None
    factor = 1.0 / sqrt(square)
    return (x, y, z, qx * factor, qy * factor, qz * factor, qw * factor)
