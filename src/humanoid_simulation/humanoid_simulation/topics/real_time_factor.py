# SPDX-License-Identifier: Apache-2.0
"""Publisher of the real-time factor."""

from __future__ import annotations

from collections.abc import Callable

from humanoid_common.qos import STATE
from humanoid_control.hosting.slowness import Speed
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from std_msgs.msg import Float64

_PERIOD_S = 1.0


class RealTimeFactorTopic:
    """
    Publisher of `real_time_factor`, once per second of real time, while simulated time passes.

    Parameters
    ----------
    node
        The node that publishes it.
    speed
        Returns the real-time factors; None if they are not known, as in a pause.

    """

    def __init__(self, node: Node, speed: Callable[[], Speed | None]) -> None:
        self._speed = speed
        self._publisher = node.create_publisher(Float64, 'real_time_factor', STATE)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(_PERIOD_S, self._publish, clock=steady)

    def _publish(self) -> None:
        """Publish the real-time factor, if it is known."""
        speed = self._speed()
        if speed is not None:
            self._publisher.publish(Float64(data=speed.reached))
