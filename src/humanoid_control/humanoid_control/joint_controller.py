# SPDX-License-Identifier: Apache-2.0
"""Node that publishes joint commands to swing the arms."""

from __future__ import annotations

import sys
from typing import Any

from humanoid_common.node_parameters import NodeParameters
from humanoid_common.periodic import PeriodicTimer
from humanoid_common.qos import COMMAND
from humanoid_common.running import run_node
from humanoid_control.conversions import command_message
from humanoid_control.joint_controller_parameters import JointControllerParameters
from humanoid_control.stop_listener import StopListener
from humanoid_control.stoppable_motion import StoppableMotion
from rclpy.node import Node
from sensor_msgs.msg import JointState


class HumanoidJointController(Node):
    """
    Node that swings joints with commands on the topic `joint_commands`, until a stop.

    The motion follows the clock of the node: with `use_sim_time` it slows down and pauses with the
    simulation. The heartbeat of the console in control is checked by a steady clock.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('humanoid_joint_controller', **options)
        self._settings = NodeParameters(self, JointControllerParameters, self._change)
        parameters = self._settings.current
        self._motion = StoppableMotion(parameters.motion)
        self._stop = StopListener(self, parameters.heartbeat_timeout_s)
        self._publisher = self.create_publisher(JointState, 'joint_commands', COMMAND)
        self._timer = PeriodicTimer(self, parameters.rate_hz, self._publish)
        self.get_logger().info(f'Humanoid Joint Controller started ({parameters.rate_hz:g} Hz)')

    def _publish(self, now_s: float) -> None:
        """Publish the current command."""
        command = self._motion.command(now_s, self._stop.must_hold)
        if command is not None:
            stamp = self.get_clock().now().to_msg()
            self._publisher.publish(command_message(command, stamp))

    def _change(self, parameters: JointControllerParameters) -> None:
        """Apply changed parameters."""
        self._motion.change(parameters.motion, self._timer.now_s())
        self._stop.guard.heartbeat_timeout_s = parameters.heartbeat_timeout_s
        self._timer.set_rate(parameters.rate_hz)
        self.get_logger().info(f'Parameters changed: {parameters}')


def main() -> int:
    """Run the node."""
    return run_node(HumanoidJointController)


if __name__ == '__main__':
    sys.exit(main())
