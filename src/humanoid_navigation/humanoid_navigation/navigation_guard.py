# SPDX-License-Identifier: Apache-2.0
"""End navigation goals when the robot falls or is stopped: the node `navigation_guard`."""

from __future__ import annotations

import sys
from typing import Any

from action_msgs.srv import CancelGoal
from humanoid_common.inhibition import Inhibition
from humanoid_common.qos import LATCHED
from humanoid_common.running import run_node
from humanoid_navigation.pose_keeper import PoseKeeper
from rclpy.node import Node
from std_msgs.msg import String

ACTIONS = ('navigate_to_pose', 'navigate_through_poses', 'follow_waypoints')


class NavigationGuard(Node):
    """
    Node that publishes why the robot cannot move on `navigation_inhibit`, and ends goals.

    The reason is empty while the robot can move. A navigator that subscribes to that topic aborts
    its goals with the reason. Goals of one that does not, such as the original Nav2, are canceled.
    A localisation that is restarted after a crash gets the last known pose of the robot.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('navigation_guard', **options)
        self._inhibition = Inhibition()
        self._said: str | None = None
        self._publisher = self.create_publisher(String, 'navigation_inhibit', LATCHED)
        self._cancels = [
            self.create_client(CancelGoal, f'{action}/_action/cancel_goal') for action in ACTIONS
        ]
        self.create_subscription(String, 'walking_state', self._tell_walking_state, LATCHED)
        self.create_subscription(String, 'stop_state', self._tell_stop_state, LATCHED)
        self._pose_keeper = PoseKeeper(self)
        self._say()

    def _tell_walking_state(self, message: String) -> None:
        self._inhibition.tell_walking_state(message.data)
        self._say()

    def _tell_stop_state(self, message: String) -> None:
        self._inhibition.tell_stop_state(message.data)
        self._say()

    def _say(self) -> None:
        """Publish the reason if it has changed; cancel all goals if no navigator subscribes."""
        reason = self._inhibition.reason
        if reason == self._said:
            return
        if reason:
            self.get_logger().warning(f'Navigation goals are canceled. {reason}')
        elif self._said:
            self.get_logger().info('Navigation goals are accepted again.')
        self._said = reason
        self._publisher.publish(String(data=reason))
        if reason and self._publisher.get_subscription_count() == 0:
            for client in self._cancels:
                if client.service_is_ready():
                    client.call_async(CancelGoal.Request())  # without an id: all goals


def main(args: list[str] | None = None) -> int:
    """
    Run the node `navigation_guard`.

    Parameters
    ----------
    args : list[str] | None
        The command line with its ROS arguments; None for that of the process.

    Returns
    -------
    int
        The exit status: 1 if the node cannot start, else 0.

    """
    return run_node(NavigationGuard, args)


if __name__ == '__main__':
    sys.exit(main())
