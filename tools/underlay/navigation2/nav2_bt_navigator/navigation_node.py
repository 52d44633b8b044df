# SPDX-License-Identifier: Apache-2.0
"""The node as its navigators see it: parameters, tree files, ROS 2 interface of trees and log."""

from __future__ import annotations

from typing import Any

from nav2_behavior_tree.odometry import OdometrySmoother
from nav2_behavior_tree.ros_interface import RosInterface
from nav2_behavior_tree.status import StatusChange
from nav2_bt_navigator.parameters import BtNavigatorParameters, UNSUPPORTED
from nav2_bt_navigator.tree_files import TreeFiles
from nav2_msgs.msg import BehaviorTreeLog, BehaviorTreeStatusChange
from nav2_util import LifecycleNode
from nav2_util.odometry import subscribe_velocity
from nav2_util.qos import LATCHED
from nav2_util.twist import Velocity
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from std_msgs.msg import String

__all__ = ['NavigationNode', 'TreeLog']


class NavigationNode(LifecycleNode):
    """
    Base class of the node: offers its navigators what their trees need.

    Parameters
    ----------
    node_name
        The node name, unless remapped.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, node_name: str, **options: Any) -> None:
        super().__init__(node_name, **options)
        self.files = TreeFiles()
        self.inhibition = ''
        """Why navigation is inhibited; empty if it is not."""

    def configure(self) -> None:
        """Read the parameters, and subscribe to what trees need."""
        self.settings = self.parameters.declare(BtNavigatorParameters)
        self.parameters.declare_unsupported(UNSUPPORTED)
        settings = self.settings.current
        self._odometry = OdometrySmoother(settings.filter_duration)
        self.ros = RosInterface(
            self,
            self._odometry,
            global_frame=settings.global_frame,
            robot_base_frame=settings.robot_base_frame,
            server_timeout_s=1e-3 * settings.default_server_timeout,
            wait_for_service_timeout_s=1e-3 * settings.wait_for_service_timeout,
            transform_tolerance_s=settings.transform_tolerance,
        )
        self.log = TreeLog(self)
        subscribe_velocity(self, settings.odom_topic, self._keep_odometry, qos_profile_sensor_data)
        if settings.inhibit_topic:
            self.create_subscription(
                String, settings.inhibit_topic, self._keep_inhibition, LATCHED
            )
        _ = self.transforms

    def cleanup(self) -> None:
        """Release the clients of trees."""
        if hasattr(self, 'ros'):
            self.ros.close()

    def _keep_inhibition(self, message: String) -> None:
        self.inhibition = message.data

    def _keep_odometry(self, stamp_s: float, velocity: Velocity) -> None:
        self._odometry.add(stamp_s, velocity.x, velocity.yaw)


class TreeLog:
    """
    Publisher of status changes on `behavior_tree_log`, if it has subscribers.

    Parameters
    ----------
    node
        The node that publishes.

    """

    def __init__(self, node: LifecycleNode) -> None:
        self._node = node
        self._publisher = node.create_publisher(BehaviorTreeLog, 'behavior_tree_log', 10)

    def publish(self, changes: list[StatusChange]) -> None:
        """
        Publish the status changes of a tick.

        Parameters
        ----------
        changes
            The changes in order; the last one is stamped with the current time.

        """
        if not changes or not self._publisher.get_subscription_count():
            return
        now = self._node.get_clock().now()
        latest_s = changes[-1].time_s
        log = BehaviorTreeLog(timestamp=now.to_msg())
        for change in changes:
            # The tree's clock may have any epoch; the stamps are in the node's time.
            stamp = Time(
                nanoseconds=max(now.nanoseconds - int(1e9 * (latest_s - change.time_s)), 0)
            )
            log.event_log.append(
                BehaviorTreeStatusChange(
                    timestamp=stamp.to_msg(),
                    node_name=change.name,
                    uid=change.uid,
                    previous_status=change.previous.value,
                    current_status=change.current.value,
                )
            )
        self._publisher.publish(log)
