# SPDX-License-Identifier: Apache-2.0
"""What the tests of tf2 share: transforms as messages, and times."""

from __future__ import annotations

from collections.abc import Sequence

from geometry_msgs.msg import TransformStamped
from rclpy.time import Time

NO_TURN = (0.0, 0.0, 0.0, 1.0)


def at(time_s: float) -> Time:
    """Return a time."""
    return Time(nanoseconds=round(time_s * 1e9))


def stamped(
    parent: str,
    child: str,
    time_s: float = 0.0,
    translation: Sequence[float] = (0.0, 0.0, 0.0),
    rotation: Sequence[float] = NO_TURN,
) -> TransformStamped:
    """Return a transform as a message."""
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id = parent
    message.header.stamp = at(time_s).to_msg()
    place, turn = message.transform.translation, message.transform.rotation
    place.x, place.y, place.z = map(float, translation)
    turn.x, turn.y, turn.z, turn.w = map(float, rotation)
    return message


def numbers(message: TransformStamped) -> list[float]:
    """Return translation and quaternion."""
    place, turn = message.transform.translation, message.transform.rotation
    return [place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w]
