# SPDX-License-Identifier: Apache-2.0
"""Give a restarted localisation the last known pose of the robot."""

from __future__ import annotations

from geometry_msgs.msg import PoseWithCovarianceStamped
from humanoid_common.qos import LATCHED, STATE
from rclpy.node import Node

__all__ = ['PoseKeeper']

_TOPIC = 'amcl_pose'
_LOOK_S = 0.5
_VARIANCES = {0: 0.1, 7: 0.1, 35: 0.05}
"""Minimum variances of x, y (m2) and yaw (rad2): the last pose is some steps old."""


class PoseKeeper:
    """
    Stores `amcl_pose`, and publishes it as `initialpose` for an AMCL that restarts after a crash.

    A restarted AMCL starts at its configured initial pose, wherever the robot is by then.

    Parameters
    ----------
    node
        The node that outlives AMCL.

    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._last: PoseWithCovarianceStamped | None = None
        self._known: frozenset[bytes] = frozenset()
        self._is_replaced = False
        self._publisher = node.create_publisher(PoseWithCovarianceStamped, 'initialpose', STATE)
        node.create_subscription(PoseWithCovarianceStamped, _TOPIC, self._take, LATCHED)
        node.create_timer(_LOOK_S, self._look)

    def _look(self) -> None:
        """Detect new publishers of poses; a killed one stays in the graph for some time."""
        found = self._node.get_publishers_info_by_topic(_TOPIC)
        gids = frozenset(bytes(each.endpoint_gid) for each in found)
        self._is_replaced |= self._last is not None and bool(gids - self._known)
        self._known |= gids

    def _take(self, message: PoseWithCovarianceStamped) -> None:
        """Store a pose, or reply to the first one of a new AMCL, which is active by then."""
        self._look()
        if not self._is_replaced or self._last is None:
            self._last = message
            return
        self._is_replaced = False
        place = self._last.pose.pose.position
        self._node.get_logger().warning(
            'Localisation restarted; its initial pose is set to where the robot was: x '
            f'{place.x:.2f}, y {place.y:.2f}.'
        )
        told = PoseWithCovarianceStamped(pose=self._last.pose)
        told.header.frame_id = self._last.header.frame_id
        for index, least in _VARIANCES.items():
            told.pose.covariance[index] = max(least, told.pose.covariance[index])
        self._publisher.publish(told)
