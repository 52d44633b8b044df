# SPDX-License-Identifier: Apache-2.0
"""The node `bt_navigator` and its navigators, which run behavior trees for navigation goals."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import PoseStamped
from nav2_behavior_tree.ros_interface import SYSTEM_DEFAULT
from nav2_bt_navigator.navigation_node import NavigationNode, UNSUPPORTED
from nav2_bt_navigator.navigator import Navigator
from nav2_msgs.action import NavigateThroughPoses, NavigateToPose
from nav2_util import ConfigurationError
from nav2_util.plugins import did_you_mean
from rclpy.action import ActionClient

__all__ = ['NAVIGATORS', 'BtNavigator', 'NavigateThroughPosesNavigator', 'NavigateToPoseNavigator']

_USUAL = {
    'navigate_to_pose': 'nav2_bt_navigator::NavigateToPoseNavigator',
    'navigate_through_poses': 'nav2_bt_navigator::NavigateThroughPosesNavigator',
}


class NavigateToPoseNavigator(Navigator):
    """
    Navigator that offers `navigate_to_pose`, and starts it for each pose on `goal_pose`.

    Parameters
    ----------
    node, name
        As for `Navigator`.

    Raises
    ------
    ConfigurationError
        The default behavior tree is invalid.

    """

    action = NavigateToPose
    default_file = 'navigate_to_pose_w_replanning_and_recovery.xml'
    file_parameter = 'default_nav_to_pose_bt_xml'
    first_code = 9000

    def __init__(self, node: NavigationNode, name: str) -> None:
        super().__init__(node, name)
        self._client = ActionClient(node, NavigateToPose, name)
        node.create_subscription(PoseStamped, 'goal_pose', self._go, SYSTEM_DEFAULT)

    def _go(self, pose: PoseStamped) -> None:
        self._client.send_goal_async(NavigateToPose.Goal(pose=pose))

    def close(self) -> None:
        """Halt the running tree, and destroy the client."""
        super().close()
        self._client.destroy()

    def goals_of(self, goal: Any) -> list[PoseStamped]:
        """
        Return the pose of a goal, as a list of one.

        Parameters
        ----------
        goal
            A goal of `nav2_msgs/NavigateToPose`.

        """
        return [goal.pose]

    def write_goal(self, blackboard: Any, poses: list[PoseStamped]) -> None:
        """
        Write the pose to the entry `goal_blackboard_id`.

        Parameters
        ----------
        blackboard, poses
            As for `Navigator.write_goal`; only the first pose is used.

        """
        blackboard.set(self.node.settings.current.goal_blackboard_id, poses[0])


class NavigateThroughPosesNavigator(Navigator):
    """Navigator that offers `navigate_through_poses`."""

    action = NavigateThroughPoses
    default_file = 'navigate_through_poses_w_replanning_and_recovery.xml'
    file_parameter = 'default_nav_through_poses_bt_xml'
    first_code = 9100

    def goals_of(self, goal: Any) -> list[PoseStamped]:
        """
        Return the poses of a goal.

        Parameters
        ----------
        goal
            A goal of `nav2_msgs/NavigateThroughPoses`.

        """
        return list(goal.poses)

    def write_goal(self, blackboard: Any, poses: list[PoseStamped]) -> None:
        """
        Write the poses to the entry `goals_blackboard_id`.

        Parameters
        ----------
        blackboard, poses
            As for `Navigator.write_goal`.

        """
        blackboard.set(self.node.settings.current.goals_blackboard_id, poses)

    def fill_feedback(self, feedback: Any, blackboard: Any) -> None:
        """
        Fill in the number of remaining poses.

        Parameters
        ----------
        feedback, blackboard
            As for `Navigator.fill_feedback`.

        """
        goals = blackboard.get(self.node.settings.current.goals_blackboard_id, [])
        feedback.number_of_poses_remaining = len(goals)


NAVIGATORS: dict[str, type[Navigator]] = {
    'nav2_bt_navigator::NavigateToPoseNavigator': NavigateToPoseNavigator,
    'nav2_bt_navigator::NavigateThroughPosesNavigator': NavigateThroughPosesNavigator,
}
"""The plugins by their official names; `/` may stand for `::`."""


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
