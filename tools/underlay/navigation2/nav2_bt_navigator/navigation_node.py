# SPDX-License-Identifier: Apache-2.0
"""The node as its navigators see it: parameters, tree files, ROS 2 interface of trees and log."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from nav2_behavior_tree.ros_interface import OdometrySmoother, RosInterface
from nav2_behavior_tree.status import StatusChange
from nav2_bt_navigator.tree_files import TreeFiles
from nav2_msgs.msg import BehaviorTreeLog, BehaviorTreeStatusChange
from nav2_util import LifecycleNode
from nav2_util.odometry import subscribe_velocity
from nav2_util.parameters import parameter, Unsupported
from nav2_util.qos import LATCHED
from nav2_util.twist import Velocity
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from std_msgs.msg import String

__all__ = ['UNSUPPORTED', 'BtNavigatorParameters', 'NavigationNode', 'TreeLog']

_NO_GROOT = 'Groot cannot connect; subscribe to behavior_tree_log instead'
UNSUPPORTED: dict[str, str | Unsupported] = {
    'default_cancel_timeout': Unsupported('canceling does not wait for the servers', (50,)),
    'enable_groot_monitoring': Unsupported(_NO_GROOT, (False,)),
    'groot_server_port': Unsupported(_NO_GROOT),
    'groot_zmq_publisher_port': Unsupported(_NO_GROOT),
    'groot_zmq_server_port': Unsupported(_NO_GROOT),
    'bt_search_directories': 'trees are named by their files',
}
"""The parameters of Nav2 that have no effect, and what happens instead."""


@dataclass(frozen=True)
class BtNavigatorParameters:
    """Parameters of the navigator; names and defaults are those of Nav2."""

    navigators: list[str] = parameter(
        ['navigate_to_pose', 'navigate_through_poses'], 'The actions to offer.', read_only=True
    )
    default_nav_to_pose_bt_xml: str = parameter(
        '', 'The tree file of navigate_to_pose; empty: the one that replans and recovers.'
    )
    default_nav_through_poses_bt_xml: str = parameter(
        '', 'The tree file of navigate_through_poses; empty: the one that replans and recovers.'
    )
    plugin_lib_names: list[str] = parameter(
        [], 'Libraries of nodes; no effect, for all nodes are there.', read_only=True
    )
    global_frame: str = parameter('map', 'The frame of goals.', read_only=True)
    robot_base_frame: str = parameter('base_link', "The robot's frame.", read_only=True)
    odom_topic: str = parameter('odom', 'Where odometry comes from.', read_only=True)
    bt_loop_duration: int = parameter(10, 'The period of ticks in ms.', low=1, high=1000)
    default_server_timeout: int = parameter(
        20, 'How long a server may take to accept a goal, in ms; at least 2 s are granted.', low=0
    )
    wait_for_service_timeout: int = parameter(
        1000, 'How long a server may be missing, in ms.', low=0
    )
    transform_tolerance: float = parameter(
        0.1, 'How old transforms may be, in s; the newest one counts here.', low=0.0
    )
    filter_duration: float = parameter(
        0.3, 'Over how long velocities are averaged, in s.', low=0.0, read_only=True
    )
    goal_blackboard_id: str = parameter(
        'goal', 'The entry of the blackboard for the goal.', read_only=True
    )
    goals_blackboard_id: str = parameter(
        'goals', 'The entry of the blackboard for the goals.', read_only=True
    )
    path_blackboard_id: str = parameter(
        'path', 'The entry of the blackboard for the path.', read_only=True
    )
    error_code_names: list[str] = parameter(
        ['follow_path_error_code', 'compute_path_error_code'],
        'The entries of the blackboard with the error codes of actions.',
    )
    error_code_name_prefixes: list[str] = parameter(
        [], 'What such names begin with, as Nav2 Kilted wants them: follow_path.'
    )
    goal_reached_tol: float = parameter(0.25, 'How near GoalReached means, in m.', low=0.0)
    goal_updater_topic: str = parameter(
        'goal_update', 'Newer goals of GoalUpdater.', read_only=True
    )
    inhibit_topic: str = parameter(
        '',
        'A latched std_msgs/String: why the robot cannot go anywhere, or empty. Not in Nav2.',
        read_only=True,
    )
    always_reload_bt_xml: bool = parameter(
        False, 'No effect: a file that was changed is always read again.'
    )


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
        self._odometry.add(stamp_s, velocity.x, velocity.yaw, velocity.y)


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
