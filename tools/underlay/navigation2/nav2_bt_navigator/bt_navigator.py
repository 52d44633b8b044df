# SPDX-License-Identifier: Apache-2.0
"""The node `bt_navigator`: runs behavior trees for navigation goals."""

from __future__ import annotations

from typing import Any

from nav2_bt_navigator.navigation_node import NavigationNode, UNSUPPORTED
from nav2_bt_navigator.navigator import Navigator
from nav2_bt_navigator.pose_navigators import (
    NavigateThroughPosesNavigator,
    NavigateToPoseNavigator,
)
from nav2_util import ConfigurationError
from nav2_util.plugins import did_you_mean

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


class BtNavigator(NavigationNode):
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

    def configure(self) -> None:
        """Create the navigators and their default trees."""
        super().configure()
        for name in self.settings.current.navigators:
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
        super().cleanup()

    def _make_navigator(self, name: str) -> Navigator:
        self.parameters.declare_unsupported(UNSUPPORTED, name)
        plugin = self.parameters.declare_value(
            f'{name}.plugin', _USUAL.get(name, ''), 'The type of this navigator.'
        )
        if not plugin:
            raise ConfigurationError(
                f"The parameter '{name}.plugin' is missing: set it to the type of the navigator."
            )
        kind = NAVIGATORS.get(plugin.replace('/', '::'))
        if kind is None:
            meant = did_you_mean(plugin, NAVIGATORS, 0.6)
            raise ConfigurationError(f"There is no navigator of type '{plugin}'.{meant}")
        return kind(self, name)
