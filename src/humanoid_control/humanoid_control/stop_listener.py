# SPDX-License-Identifier: Apache-2.0
"""Topics of a stop: emergency stop, console heartbeat and stop state."""

from __future__ import annotations

import time

from humanoid_common.qos import LATCHED
from humanoid_control.stop_guard import StopGuard
from rclpy.clock import Clock, ClockType
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Bool, String

NEWEST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
CHECK_S = 0.05
"""Period of the check for a lost console, by a steady clock."""


class StopListener:
    """
    Subscriber to `emergency_stop` and `console_heartbeat`, and publisher of `stop_state`.

    `emergency_stop` has two subscriptions: a latched one, which also receives messages from before
    this node started, and a best-effort one, for publishers that are volatile or best-effort.

    The heartbeat is checked in real time, also while a simulation is paused.

    Parameters
    ----------
    node
        The node that subscribes and publishes.
    heartbeat_timeout_s
        How long the console in control may be silent, in real time.
    robot
        Namespace of the robot, relative to that of the node; empty if it has none of its own.

    Attributes
    ----------
    guard
        Decides whether the robot must hold still; its timeout may be changed.

    """

    def __init__(self, node: Node, heartbeat_timeout_s: float, robot: str = '') -> None:
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
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(CHECK_S, self._check, clock=steady)

    @property
    def must_hold(self) -> bool:
        """Whether the robot must hold still."""
        return bool(self.guard.reason)

    def _order(self, message: Bool) -> None:
        self.guard.order(message.data)
        self._say_news()

    def _check(self) -> None:
        """Check the heartbeat of the console."""
        self.guard.check(time.monotonic())
        self._say_news()

    def _heartbeat(self, message: Bool) -> None:
        self.guard.heartbeat(message.data)

    def _say_news(self) -> None:
        """Publish and log the stop state when it has changed."""
        reason = self.guard.reason
        if reason == self._said:
            return
        self._said = reason
        self._state.publish(String(data=reason))
        if reason:
            self._log.warning(
                f'Holding still: {reason}. It moves on when false is published on '
                f"'{self._release}'."
            )
        else:
            self._log.info('Released: moving on')
