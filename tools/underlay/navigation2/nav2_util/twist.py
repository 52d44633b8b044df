# SPDX-License-Identifier: Apache-2.0
"""Velocity commands on topics, as `Twist` or, with `enable_stamped_cmd_vel`, as `TwistStamped`."""

from __future__ import annotations

from collections.abc import Callable
import math
from typing import Any, NamedTuple, TYPE_CHECKING

from geometry_msgs.msg import Twist, TwistStamped
import numpy as np
import numpy.typing as npt
from std_msgs.msg import Header

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['TwistPublisher', 'Velocity', 'subscribe_twist', 'velocity_of']


class Velocity(NamedTuple):
    """Velocity in the plane, in the robot's base frame: x and y in m/s, yaw rate in rad/s."""

    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0

    @property
    def is_finite(self) -> bool:
        """Whether all components are finite."""
        return math.isfinite(self.x) and math.isfinite(self.y) and math.isfinite(self.yaw)

    @property
    def is_zero(self) -> bool:
        """Whether all components are zero."""
        return not (self.x or self.y or self.yaw)

    @property
    def linear(self) -> float:
        """Return the linear speed in m/s."""
        return math.hypot(self.x, self.y)

    def scaled(self, factor: float) -> Velocity:
        """
        Scale the velocity, which preserves the curvature.

        Parameters
        ----------
        factor
            The factor of x, y and yaw rate.

        """
        return Velocity(self.x * factor, self.y * factor, self.yaw * factor)

    def poses_after(self, times_s: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """
        Compute the poses of a robot at this constant velocity.

        Parameters
        ----------
        times_s
            (K,) array.

        Returns
        -------
        numpy.ndarray
            (K, 3) poses x, y (m), yaw (rad) in the current base frame: arcs, or straight lines.

        """
        yaw = self.yaw * times_s
        # sin(yaw) / rate and (1 - cos(yaw)) / rate, which are also valid without rotation.
        along = times_s * np.sinc(yaw / math.pi)
        across = times_s * np.sinc(0.5 * yaw / math.pi) * np.sin(0.5 * yaw)
        return np.column_stack(
            [self.x * along - self.y * across, self.x * across + self.y * along, yaw]
        )


def velocity_of(twist: Twist) -> Velocity:
    """
    Project a twist onto the plane.

    Parameters
    ----------
    twist
        The message, of which x, y (m/s) and the yaw rate (rad/s) are used.

    """
    return Velocity(twist.linear.x, twist.linear.y, twist.angular.z)


class TwistPublisher:
    """
    Publisher of velocities, as messages with or without a header.

    Parameters
    ----------
    node
        The node that publishes.
    topic
        The topic, such as `cmd_vel`.
    is_stamped
        Whether to publish `TwistStamped` instead of `Twist`.
    frame
        The frame of the default header.

    """

    def __init__(self, node: Node, topic: str, is_stamped: bool, frame: str = 'base_link') -> None:
        self._node, self._is_stamped, self._frame = node, is_stamped, frame
        self._publisher = node.create_publisher(TwistStamped if is_stamped else Twist, topic, 1)

    def publish(self, velocity: Velocity, header: Header | None = None) -> None:
        """
        Publish a velocity.

        Parameters
        ----------
        velocity
            The velocity in the base frame (m/s, rad/s).
        header
            The header of a `TwistStamped`; by default the frame of the class and the current time.

        """
        twist = Twist()
        twist.linear.x, twist.linear.y = float(velocity.x), float(velocity.y)
        twist.angular.z = float(velocity.yaw)
        if not self._is_stamped:
            self._publisher.publish(twist)
            return
        if header is None:
            header = Header(frame_id=self._frame, stamp=self._node.get_clock().now().to_msg())
        self._publisher.publish(TwistStamped(header=header, twist=twist))


def subscribe_twist(
    node: Node,
    topic: str,
    is_stamped: bool,
    callback: Callable[[Velocity, Header | None], None],
) -> None:
    """
    Subscribe to the velocities of a topic.

    Non-finite velocities are ignored with an error, logged at most once a second.

    Parameters
    ----------
    node, topic
        The node that subscribes, and a topic such as `cmd_vel`.
    is_stamped
        Whether its type is `TwistStamped` instead of `Twist`.
    callback
        Called with each velocity, and its header if any.

    """

    def receive(message: Any) -> None:
        velocity = velocity_of(message.twist if is_stamped else message)
        if velocity.is_finite:
            callback(velocity, message.header if is_stamped else None)
            return
        node.get_logger().error(
            f"Ignored a velocity on '{topic}' that is not finite: "
            f'x {velocity.x}, y {velocity.y}, yaw rate {velocity.yaw}.',
            throttle_duration_sec=1.0,
        )

    node.create_subscription(TwistStamped if is_stamped else Twist, topic, receive, 1)
