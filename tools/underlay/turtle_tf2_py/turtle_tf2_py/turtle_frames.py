# SPDX-License-Identifier: Apache-2.0
"""Poses in the plane as transforms."""

from __future__ import annotations

import math

from builtin_interfaces.msg import Time
from geometry_msgs.msg import TransformStamped

__all__ = ['planar_transform']


def planar_transform(
    parent: str, child: str, stamp: Time, x: float, y: float, yaw_rad: float = 0.0
) -> TransformStamped:
    """
    Build the transform of a frame that lies in the plane of its parent.

    Parameters
    ----------
    parent, child
        The names of the frames.
    stamp
        The time at which the transform holds.
    x, y
        The position in the parent, in m.
    yaw_rad
        The rotation about the z axis.

    """
    transform = TransformStamped()
    transform.header.stamp = stamp
    transform.header.frame_id = parent
    transform.child_frame_id = child
    transform.transform.translation.x = float(x)
    transform.transform.translation.y = float(y)
    transform.transform.rotation.z = math.sin(yaw_rad / 2.0)
    transform.transform.rotation.w = math.cos(yaw_rad / 2.0)
    return transform
