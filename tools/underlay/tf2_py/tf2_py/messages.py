# SPDX-License-Identifier: Apache-2.0
"""Convert times and transforms of messages to numbers and back."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import TransformStamped
from tf2_py.poses import Pose

_NS_PER_S = 10**9
Reading = tuple[str, str, int, Pose]
"""The parent frame, the child frame, the stamp in ns, and the pose of the child."""


def nanoseconds(time: Any) -> int:
    """
    Convert a time or duration to nanoseconds.

    Parameters
    ----------
    time
        A `Time` or `Duration` of rclpy, or of `builtin_interfaces`.

    Raises
    ------
    TypeError
        The argument is neither a time nor a duration.

    """
    try:
        return time.nanoseconds  # type: ignore[no-any-return]
    except AttributeError:
        pass
    try:
        return int(time.sec * _NS_PER_S + time.nanosec)
    except AttributeError:
        raise TypeError(
            f'{time!r} is neither a time nor a duration: use rclpy.time.Time, '
            'rclpy.duration.Duration(seconds=...) or the stamp of a message'
        ) from None


def pose_of(transform: Any) -> Pose:
    """
    Extract the numbers of a `geometry_msgs/Transform`.

    Parameters
    ----------
    transform
        The message.

    Returns
    -------
    Pose
        Translation in m and quaternion x, y, z, w.

    """
    translation = transform.translation
    rotation = transform.rotation
    return (
        translation.x,
        translation.y,
        translation.z,
        rotation.x,
        rotation.y,
        rotation.z,
        rotation.w,
    )


def reading_of(transform: Any) -> Reading:
    """
    Extract the names and numbers of a `geometry_msgs/TransformStamped`.

    Parameters
    ----------
    transform
        The message.

    Returns
    -------
    Reading
        Parent frame, child frame, stamp in ns, and pose of the child.

    """
    header = transform.header
    return (
        header.frame_id,
        transform.child_frame_id,
        nanoseconds(header.stamp),
        pose_of(transform.transform),
    )


def transform_message(parent: str, child: str, time_ns: int, pose: Pose) -> TransformStamped:
    """
    Build a `geometry_msgs/TransformStamped`.

    Parameters
    ----------
    parent, child
        The frame of the header, and the child frame.
    time_ns
        The stamp in ns.
    pose
        Pose of the child in the parent: translation in m, quaternion x, y, z, w.

    """
    message = TransformStamped()
    header = message.header
    header.frame_id = parent
    header.stamp.sec, header.stamp.nanosec = divmod(time_ns, _NS_PER_S)
    message.child_frame_id = child
    translation = message.transform.translation
    rotation = message.transform.rotation
    translation.x, translation.y, translation.z = pose[:3]
    rotation.x, rotation.y, rotation.z, rotation.w = pose[3:]
    return message
