# SPDX-License-Identifier: Apache-2.0
"""Notice that a hand has lost what it holds, also between the goals."""

from __future__ import annotations

from typing import Any

from humanoid_common.qos import SENSOR
from humanoid_manipulation.arms import Arms
from humanoid_manipulation.hands import has_lost
from humanoid_manipulation.held_things import HeldThings
from rclpy.node import Node
from sensor_msgs.msg import JointState

__all__ = ['SlipWatch']


class SlipWatch:
    """
    Compares the gaps of the grippers with those of the grasps while no goal runs.

    It subscribes to the joint states only while something is held, because of their rate. A goal
    checks the hands itself.

    Parameters
    ----------
    node
        The node that owns the subscription.
    arms
        Tells whether a goal runs, and which joints are those of the grippers.
    held
        The held objects; one that is lost is removed.

    """

    def __init__(self, node: Node, arms: Arms, held: HeldThings) -> None:
        self._node, self._arms, self._held = node, arms, held
        self._subscription: Any = None

    def update(self) -> None:
        """Start to watch if something is held, else stop. Call after each change."""
        if self._held and self._subscription is None:
            self._subscription = self._node.create_subscription(
                JointState, 'joint_states', self._take, SENSOR
            )
        elif not self._held and self._subscription is not None:
            # Not at once: this may be called by the subscription itself.
            subscription, self._subscription = self._subscription, None
            assert self._node.executor is not None
            self._node.executor.create_task(self._node.destroy_subscription, subscription)

    def _take(self, message: JointState) -> None:
        if self._arms.is_listening:
            return
        positions = dict(zip(message.name, message.position))
        for side, held in list(self._held.items()):
            finger_m = positions.get(self._arms.finger_of(side))
            if finger_m is not None and has_lost(held, 2.0 * finger_m):
                self._node.get_logger().warning(
                    f'The {side} hand no longer holds {held.object_id}.'
                )
                del self._held[side]
