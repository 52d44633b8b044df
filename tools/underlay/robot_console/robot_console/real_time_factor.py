# SPDX-License-Identifier: Apache-2.0
"""Real-time factor of a simulator."""

from __future__ import annotations

import math
import time

from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Float64

__all__ = ['RealTimeFactor']

TOPIC = 'real_time_factor'
STALE_S = 3.0
"""Simulators publish once a second; one that is silent for longer is paused or gone."""


class RealTimeFactor:
    """
    Subscribes to the real-time factor that a simulator publishes on `real_time_factor`.

    Parameters
    ----------
    node
        The node that subscribes; the topic is relative to its namespace.

    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._heard: tuple[float, float] | None = None
        newest = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
        self._subscription = node.create_subscription(Float64, TOPIC, self._hear, newest)

    def factor(self, now_s: float) -> float | None:
        """
        Return the current real-time factor.

        Parameters
        ----------
        now_s
            The current time, from `time.monotonic`.

        Returns
        -------
        float or None
            Simulated seconds per real second; None if no message was received for 3 s.

        """
        if self._heard is None or now_s - self._heard[0] > STALE_S:
            return None
        return self._heard[1]

    def close(self) -> None:
        """Destroy the subscription."""
        self._node.destroy_subscription(self._subscription)

    def _hear(self, message: Float64) -> None:
        if math.isfinite(message.data):
            self._heard = time.monotonic(), message.data
