# SPDX-License-Identifier: Apache-2.0
"""Walk around a square by odometry: `ros2 run humanoid_simulation walk_square`."""

from __future__ import annotations

from dataclasses import dataclass
import sys
from typing import Any

from geometry_msgs.msg import Twist
from humanoid_common.node_parameters import NodeParameters
from humanoid_common.parameters import parameter
from humanoid_common.qos import COMMAND, STATE
from humanoid_common.running import ending, run_node
from humanoid_control.hosting.conversions import seconds
from humanoid_simulation.examples.conversions import height_and_tilt, planar_pose, twist_message
from humanoid_simulation.examples.fall_watch import FallWatch
from humanoid_simulation.examples.needs_simulator import SimulatorWatch
from humanoid_simulation.examples.square_walk import (
    SquarePlan,
    SquareWalk,
    WalkUpdate,
)
from nav_msgs.msg import Odometry
import rclpy
from rclpy.duration import Duration
from rclpy.node import Node


@dataclass(frozen=True)
class WalkSquareParameters:
    """Parameters of `walk_square`: size of the square, and speeds."""

    side_m: float = parameter(
        1.0, 'Length of a side.', at_least=0.2, at_most=100.0, read_only=True
    )
    speed_m_s: float = parameter(
        0.2, 'Speed along the sides.', at_least=0.05, at_most=0.5, read_only=True
    )
    turn_rad_s: float = parameter(
        0.4, 'Speed of the turns.', at_least=0.1, at_most=1.0, read_only=True
    )

    @property
    def plan(self) -> SquarePlan:
        """Return the plan that the parameters describe."""
        return SquarePlan(self.side_m, self.speed_m_s, self.turn_rad_s)


class WalkSquare(Node):
    """
    Node that drives around a square by `odom`; `ground_truth/odom` is for the evaluation only.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('walk_square', **options)
        self._plan = NodeParameters(self, WalkSquareParameters).current.plan
        self._fall_watch = FallWatch()
        self._truth: Odometry | None = None
        self._walk: SquareWalk | None = None
        self._publisher = self.create_publisher(Twist, 'cmd_vel', COMMAND)
        self._simulator = SimulatorWatch(self, "'odom' and 'ground_truth/odom'")
        self.create_subscription(Odometry, 'ground_truth/odom', self._keep_truth, STATE)
        self.create_subscription(Odometry, 'odom', ending(self, self._go_on), STATE)

    def destroy_node(self) -> None:
        """Stop the robot, and destroy the node."""
        if self.context.ok():
            self._publisher.publish(Twist())
            self._publisher.wait_for_all_acked(Duration(seconds=1))
        super().destroy_node()

    def _keep_truth(self, message: Odometry) -> None:
        """Store the ground truth."""
        self._truth = message

    def _go_on(self, message: Odometry) -> None:
        """Compute and publish the velocity command, once both topics have been received."""
        if self._truth is None or not self.context.ok():
            return  # no ground truth yet, or the walk is over and messages were still queued
        self._simulator.heard()
        progress = self._progress(message, self._truth)
        self._publisher.publish(twist_message(progress.command))
        self._say(progress)

    def _progress(self, message: Odometry, truth: Odometry) -> WalkUpdate:
        """Update the walk, which starts with the first message."""
        where = seconds(message.header.stamp), planar_pose(message), planar_pose(truth)
        if self._walk is None:
            self.get_logger().info(f'Walking around a square of {self._plan.side_m:g} m')
            self._walk = SquareWalk(self._plan, *where)
        stands = self._fall_watch.stands(*height_and_tilt(truth))
        return self._walk.update(*where, stands)

    def _say(self, progress: WalkUpdate) -> None:
        """Log the progress, and shut down when the walk is done."""
        if progress.news:
            self.get_logger().info(progress.news)
        if progress.is_done:
            rclpy.try_shutdown(context=self.context)


def main() -> int:
    """Run the node."""
    return run_node(WalkSquare)


if __name__ == '__main__':
    sys.exit(main())
