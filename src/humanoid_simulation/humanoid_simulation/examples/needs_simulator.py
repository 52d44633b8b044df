# SPDX-License-Identifier: Apache-2.0
"""End a node that waits for a simulator which does not run."""

from __future__ import annotations

from humanoid_common.errors import NodeStartError
from humanoid_common.running import ending
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

PATIENCE_S = 5.0


class ExampleError(NodeStartError):
    """Tell why an example cannot start or go on."""


class SimulatorWatch:
    """
    Watchdog that ends a node with an error when nothing comes from the simulator for a while.

    Parameters
    ----------
    node
        The node, which calls `heard` at each message.
    topics
        What is listened to, as the error names it: `'odom' and 'ground_truth/odom'`.
    patience_s
        How often to check that something has come, in s of real time.

    """

    def __init__(self, node: Node, topics: str, patience_s: float = PATIENCE_S) -> None:
        self._node = node
        self._topics = topics
        self._heard = False
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(patience_s, ending(node, self._look), clock=steady)

    def heard(self) -> None:
        """Note that the simulator is there."""
        self._heard = True

    def _look(self) -> None:
        """Raise if nothing came since the last look."""
        if not self._heard:
            raise ExampleError(
                f'Nothing comes on {self._topics} (namespace {self._node.get_namespace()}): '
                'either no simulator runs there, or it is paused. Start one with '
                "'ros2 launch humanoid_simulation simulation.launch.py'."
            )
        self._heard = False
