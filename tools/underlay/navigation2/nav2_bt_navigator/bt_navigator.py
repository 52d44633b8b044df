# SPDX-License-Identifier: Apache-2.0
"""The node `bt_navigator`: runs behavior trees for navigation goals."""

from __future__ import annotations

from typing import Any

from nav2_behavior_tree.odometry import OdometrySmoother
from nav2_behavior_tree.ros_interface import RosInterface
from nav2_bt_navigator.navigate_through_poses import NavigateThroughPosesNavigator
from nav2_bt_navigator.navigate_to_pose import NavigateToPoseNavigator
from nav2_bt_navigator.navigator import Navigator
from nav2_bt_navigator.parameters import BtNavigatorParameters, UNSUPPORTED
from nav2_bt_navigator.tree_files import TreeFiles
from nav2_bt_navigator.tree_log import TreeLog
from nav2_util import ConfigurationError, LifecycleNode
from nav2_util.odometry import subscribe_velocity
from nav2_util.plugins import did_you_mean
from nav2_util.qos import LATCHED
from nav2_util.twist import Velocity
from rclpy.qos import qos_profile_sensor_data
from std_msgs.msg import String

__all__ = ['NAVIGATORS', 'BtNavigator']


NAVIGATORS: dict[str, type[Navigator]] = {
    'nav2_bt_navigator::NavigateToPoseNavigator': NavigateToPoseNavigator,
    'nav2_bt_navigator::NavigateThroughPosesNavigator': NavigateThroughPosesNavigator,
}
"""The plugins by their official names; `/` may stand for `::`."""
_USUAL = {
    'navigate_to_pose': 'nav2_bt_navigator::NavigateToPoseNavigator',
    'navigate_through_poses': 'nav2_bt_navigator::NavigateThroughPosesNavigator',
}


class BtNavigator(LifecycleNode):
    """
    Node that offers the actions `navigate_to_pose` and `navigate_through_poses`.

    Parameters
    ----------
    node_name
        The node name, unless remapped.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    result_timeout_s = 900.0

    def __init__(self, node_name: str = 'bt_navigator', **options: Any) -> None:
        super().__init__(node_name, **options)
        self.navigators: list[Navigator] = []
        self.files = TreeFiles()
        self.inhibition = ''
        """Why navigation is inhibited; empty if it is not."""

    def configure(self) -> None:
        """Create the navigators and their default trees."""
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
        for name in settings.navigators:
            self.navigators.append(self._make_navigator(name))

    def deactivate(self) -> None:
        """Abort the running goal immediately."""
        for navigator in self.navigators:
            navigator.step()

    def cleanup(self) -> None:
        """Release the navigators."""
        for navigator in self.navigators:
            navigator.close()
        self.navigators.clear()
        if hasattr(self, 'ros'):
            self.ros.close()

    def _make_navigator(self, name: str) -> Navigator:
        self.parameters.declare_unsupported(UNSUPPORTED, name)
        plugin = self.parameters.declare_value(
            f'{name}.plugin', _USUAL.get(name, ''), 'The type of this navigator.'
        )
        if not plugin:
            raise ConfigurationError(
                f"The parameter '{name}.plugin' is missing: it names the type of the navigator."
            )
        kind = NAVIGATORS.get(plugin.replace('/', '::'))
        if kind is None:
            meant = did_you_mean(plugin, NAVIGATORS, 0.6)
            raise ConfigurationError(f"There is no navigator of the type '{plugin}'.{meant}")
        return kind(self, name)

    def _keep_inhibition(self, message: String) -> None:
        self.inhibition = message.data

    def _keep_odometry(self, stamp_s: float, velocity: Velocity) -> None:
        self._odometry.add(stamp_s, velocity.x, velocity.yaw)
