# SPDX-License-Identifier: Apache-2.0
"""Publish the status changes of a tree's nodes."""

from __future__ import annotations

from nav2_behavior_tree import StatusChange
from nav2_msgs.msg import BehaviorTreeLog, BehaviorTreeStatusChange
from nav2_util import LifecycleNode
from rclpy.time import Time

__all__ = ['TreeLog']


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
