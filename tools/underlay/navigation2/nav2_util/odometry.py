# SPDX-License-Identifier: Apache-2.0
"""Read velocities from serialized odometry, without deserializing the messages."""

from __future__ import annotations

from collections.abc import Callable
import struct
from typing import Any

from nav2_util.twist import Velocity, velocity_of
from nav_msgs.msg import Odometry
from rclpy.serialization import deserialize_message

__all__ = ['subscribe_velocity', 'velocity_in']

_ORDERS = {b'\0\0': '>', b'\0\1': '<'}
_STAMP = 8
_POSE = (7 + 36) * 8
_TWIST = (6 + 36) * 8


def subscribe_velocity(
    node: Any, topic: str, take: Callable[[float, Velocity], None], qos: Any = 10
) -> None:
    """
    Subscribe to the velocity of the robot.

    rclpy takes 0.2 ms to deserialize a message with its two covariances, which is expensive at 50
    to 100 Hz.

    Parameters
    ----------
    node
        The node that subscribes.
    topic
        The topic of `nav_msgs/Odometry`.
    take
        Called with the stamp in s and the velocity of each message.
    qos
        The quality of service, or the depth.

    """
    node.create_subscription(Odometry, topic, lambda data: take(*velocity_in(data)), qos, raw=True)


def velocity_in(data: bytes) -> tuple[float, Velocity]:
    """
    Read the stamp and the velocity of a serialized `nav_msgs/Odometry`.

    In CDR, numbers are aligned to their size, counted from the fifth byte: a stamp, two strings
    with their lengths, the pose and the twist with a covariance each.

    Parameters
    ----------
    data
        The message in CDR, as from a raw subscription.

    Returns
    -------
    tuple
        The stamp of the header in s, and the velocity in the child frame (m/s, rad/s).

    """
    order = _ORDERS.get(bytes(data[:2]))
    if order is not None:
        body = memoryview(data)[4:]
        try:
            at = _STAMP
            for _ in range(2):
                at += -at % 4
                at += 4 + int(struct.unpack_from(f'{order}I', body, at)[0])
            at += -at % 8 + _POSE
            if at + _TWIST == len(body):
                x, y, _, _, _, yaw = struct.unpack_from(f'{order}6d', body, at)
                sec, nanosec = struct.unpack_from(f'{order}iI', body)
                return sec + 1e-9 * nanosec, Velocity(x, y, yaw)
        except struct.error:
            pass
    message = deserialize_message(data, Odometry)
    stamp = message.header.stamp
    return stamp.sec + 1e-9 * stamp.nanosec, velocity_of(message.twist.twist)
