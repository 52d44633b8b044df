# SPDX-License-Identifier: Apache-2.0
"""A transform listener that is polled once per drawn frame."""

from __future__ import annotations

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rviz_common.polled_topic import WaitingGroup
from tf2_ros import Buffer, TransformListener

__all__ = ['FrameListener']

# More than robots publish between two frames; older messages are dropped.
DEPTH = 1000
MOVING = QoSProfile(depth=DEPTH)
STATIC = QoSProfile(depth=DEPTH, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class FrameListener(TransformListener):
    """
    Transform listener that is polled: it fills a buffer whenever `take_all` is called.

    Waking an executor for each message costs more than reading the transforms from it.
    While it rests, it receives static transforms only: dynamic ones arrive some 100 times a
    second, so that all of them are known again a moment after `resume`.

    Parameters
    ----------
    buffer
        Receives the transforms.
    node
        Subscribes to `/tf` and `/tf_static`.

    """

    def __init__(self, buffer: Buffer, node: Node) -> None:
        super().__init__(buffer, node, qos=MOVING, static_qos=STATIC)

    def take_all(self) -> None:
        """Process all messages received since the last call, static transforms first."""
        for subscription in (self.tf_static_sub, self.tf_sub):
            for _ in range(DEPTH if subscription is not None else 0):
                with subscription.handle:
                    found = subscription.handle.take_message(subscription.msg_type, True)
                if found is None:
                    break
                subscription.callback(found[0])

    def rest(self) -> None:
        """Unsubscribe from `/tf`."""
        if self.tf_sub is not None:
            self.node.destroy_subscription(self.tf_sub)
            self.tf_sub = None

    def resume(self) -> None:
        """Subscribe to `/tf` again."""
        if self.tf_sub is None:
            self.tf_sub = self._subscribe('/tf', False, MOVING)

    def _group(self) -> ReentrantCallbackGroup:
        return WaitingGroup()
