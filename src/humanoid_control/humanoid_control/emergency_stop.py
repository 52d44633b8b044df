# SPDX-License-Identifier: Apache-2.0
"""Stop of a robot: emergency stop, and heartbeat watchdog of the console in control."""

from __future__ import annotations

import time

from humanoid_common.qos import LATCHED
from rclpy.clock import Clock, ClockType
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Bool, String

PRESSED = 'the emergency stop is pressed'
NEWEST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
CHECK_S = 0.05
"""Period of the check for a lost console, by a steady clock."""


class StopGuard:
    """
    Watchdog that decides whether the robot must hold still, and why.

    There are two reasons: the emergency stop was pressed, or the console in control was lost. Both
    last until a person releases the emergency stop.

    Parameters
    ----------
    heartbeat_timeout_s
        How long a console in control may be silent, in real time.

    """

    def __init__(self, heartbeat_timeout_s: float) -> None:
        self.heartbeat_timeout_s = heartbeat_timeout_s
        self._reason = ''
        self._in_control = False
        self._silent_s = 0.0
        self._checked_s: float | None = None

    @property
    def reason(self) -> str:
        """Return the reason why the robot must hold still; empty if it may move."""
        return self._reason

    def order(self, stop: bool) -> None:
        """
        Handle a message of the emergency stop.

        Parameters
        ----------
        stop
            True stops the robot. False releases it, also after the console was lost.

        """
        self._reason = PRESSED if stop else ''

    def heartbeat(self, in_control: bool) -> None:
        """
        Handle a heartbeat of a console, which restarts the timeout.

        Parameters
        ----------
        in_control
            Whether the console controls the robot; only then are further heartbeats required.

        """
        self._in_control = in_control
        self._silent_s = 0.0

    def check(self, now_s: float) -> str:
        """
        Check the heartbeat timeout of the console in control; call it several times per timeout.

        The time between two checks counts for at most half of the timeout: when this computer
        stalled, messages that have arrived meanwhile are handled first.

        Parameters
        ----------
        now_s
            Time of a steady clock.

        Returns
        -------
        str
            The reason why the robot must hold still; empty if it may move.

        """
        if self._checked_s is not None:
            elapsed_s = now_s - self._checked_s
            self._silent_s += min(elapsed_s, self.heartbeat_timeout_s / 2)
        self._checked_s = now_s
        if self._in_control and self._silent_s >= self.heartbeat_timeout_s:
            self._in_control = False
            self._reason = self._reason or self._gone()
        return self._reason

    def _gone(self) -> str:
        """Build the message about a lost console."""
        return (
            f'the console in control is lost, with no heartbeat for {self.heartbeat_timeout_s:g} s'
        )


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
                f"Holding still: {reason}. To release it, publish false on '{self._release}'."
            )
        else:
            self._log.info('Released: moving again')
