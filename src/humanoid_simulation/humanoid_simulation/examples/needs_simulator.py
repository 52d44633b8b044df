# SPDX-License-Identifier: Apache-2.0
"""End a node if the simulator that it needs does not run."""

from __future__ import annotations

from humanoid_common.errors import UserError
from humanoid_common.running import ending
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

PATIENCE_S = 5.0


class ExampleError(UserError):
    """An example cannot start or continue."""


class SimulatorWatch:
    """
    Watchdog that ends a node with an error if no message arrives from the simulator for a while.

    Parameters
    ----------
    node
        The node, which calls `heard` at each message.
    topics
        The subscribed topics, as the error message names them: `'odom' and 'ground_truth/odom'`.
    patience_s
        Period at which to check that a message has arrived, in s of real time.

    """

    def __init__(self, node: Node, topics: str, patience_s: float = PATIENCE_S) -> None:
        self._node = node
        self._topics = topics
        self._heard = False
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(patience_s, ending(node, self._look), clock=steady)

    def heard(self) -> None:
        """Reset the watchdog."""
        self._heard = True

    def _look(self) -> None:
        """Raise ExampleError if no message has arrived since the last check."""
        if not self._heard:
            raise ExampleError(
                f'No messages on {self._topics} (namespace {self._node.get_namespace()}): either '
                "no simulator is running there, or it is paused. Start one with 'ros2 launch "
                "humanoid_simulation simulation.launch.py'."
            )
        self._heard = False
