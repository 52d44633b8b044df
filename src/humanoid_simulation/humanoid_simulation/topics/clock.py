# SPDX-License-Identifier: Apache-2.0
"""Publisher of the simulated time."""

from __future__ import annotations

from humanoid_common.qos import STATE
from humanoid_control.hosting.topics.filling import fill_stamp
from rclpy.node import Node
from rosgraph_msgs.msg import Clock


class ClockTopic:
    """
    Publisher of `/clock`, the same in all namespaces; its time never jumps back.

    Parameters
    ----------
    node
        The node that publishes it.

    """

    def __init__(self, node: Node) -> None:
        self._message = Clock()
        self._publisher = node.create_publisher(Clock, '/clock', STATE)

    def publish(self, time_s: float) -> None:
        """
        Publish the simulated time.

        Parameters
        ----------
        time_s
            Simulated time since the start.

        """
        fill_stamp(self._message.clock, time_s)
        self._publisher.publish(self._message)
