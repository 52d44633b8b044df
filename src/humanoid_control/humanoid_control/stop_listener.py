# SPDX-License-Identifier: Apache-2.0
"""Hear who stops the robot, and say that it holds still."""

from __future__ import annotations

import time

from humanoid_common.qos import LATCHED
from humanoid_control.stop_guard import StopGuard
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Bool, String

NEWEST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


class StopListener:
    """
    The topics of a stop: `emergency_stop` and `console_heartbeat`; says `stop_state`.

    A stop is heard twice: once with what was said before this node started, and once from
    publishers that keep nothing for those who join late, or send nothing twice.
    """

    def __init__(self, node: Node, heartbeat_timeout_s: float, robot: str = '') -> None:
        """Begin to listen; `robot` is a namespace in that of the node."""
        place = f'{robot}/' if robot else ''
        self.guard = StopGuard(heartbeat_timeout_s)
        self._log = node.get_logger()
        self._release = f'{place}emergency_stop'
        self._said = ''
        self._state = node.create_publisher(String, f'{place}stop_state', LATCHED)
        self._state.publish(String())
        quiet = SubscriptionEventCallbacks(use_default_callbacks=False)
        for qos in (LATCHED, NEWEST):
            node.create_subscription(
                Bool, f'{place}emergency_stop', self._order, qos, event_callbacks=quiet
            )
        node.create_subscription(Bool, f'{place}console_heartbeat', self._heartbeat, NEWEST)

    def must_hold(self) -> bool:
        """Tell whether the robot must hold still; the first time, say why."""
        reason = self.guard.check(time.monotonic())
        if reason != self._said:
            self._said = reason
            self._say(reason)
        return bool(reason)

    def _order(self, message: Bool) -> None:
        self.guard.order(message.data)

    def _heartbeat(self, message: Bool) -> None:
        self.guard.heartbeat(message.data)

    def _say(self, reason: str) -> None:
        self._state.publish(String(data=reason))
        if reason:
            self._log.warning(
                f'Holding still: {reason}. It moves on when false is published on '
                f"'{self._release}'."
            )
        else:
            self._log.info('Released: moving on')
