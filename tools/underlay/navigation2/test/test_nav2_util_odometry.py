# SPDX-License-Identifier: Apache-2.0
"""Velocities out of the bytes of odometry."""

from __future__ import annotations

from nav2_util.odometry import velocity_in
from nav_msgs.msg import Odometry
import pytest
from rclpy.serialization import serialize_message


@pytest.mark.parametrize('frame', ['', 'odom', 'robot/odom'])
@pytest.mark.parametrize('child', ['', 'base', 'base_link', 'base_footprint'])
def test_velocity_is_read_whatever_the_names(frame, child):
    """Time and velocity are those of the message, however long its names are."""
    message = Odometry(child_frame_id=child)
    message.header.frame_id = frame
    message.header.stamp.sec, message.header.stamp.nanosec = 7, 500_000_000
    message.twist.twist.linear.x, message.twist.twist.linear.y = 0.25, -0.5
    message.twist.twist.angular.z = 0.75
    message.pose.pose.position.x = 3.0
    message.pose.covariance[0] = message.twist.covariance[35] = 9.0
    assert velocity_in(serialize_message(message)) == (7.5, (0.25, -0.5, 0.75))


def test_other_bytes_are_left_to_the_deserializer():
    """Bytes that are laid out in another way are read as messages, or refused as such."""
    data = serialize_message(Odometry())
    assert velocity_in(data + bytes(4)) == (0.0, (0.0, 0.0, 0.0))
    with pytest.raises(Exception, match='deserialize'):
        velocity_in(data[:40])
