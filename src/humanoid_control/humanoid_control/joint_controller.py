# SPDX-License-Identifier: Apache-2.0
"""Publish joint commands that swing the arms."""

from __future__ import annotations

import sys
from typing import Any

from humanoid_common.node_parameters import NodeParameters
from humanoid_common.qos import COMMAND
from humanoid_common.running import run_node
from humanoid_common.steady import SteadyTimer
from humanoid_control.conversions import command_message
from humanoid_control.joint_controller_parameters import JointControllerParameters
from rclpy.node import Node
from sensor_msgs.msg import JointState


class HumanoidJointController(Node):
    """Swings the joints that its parameters name, on the topic `joint_commands`."""

    def __init__(self, **options: Any) -> None:
        """Start to publish."""
        super().__init__('humanoid_joint_controller', **options)
        self._settings = NodeParameters(self, JointControllerParameters, self._change)
        parameters = self._settings.current
        self._motion = parameters.motion
        self._publisher = self.create_publisher(JointState, 'joint_commands', COMMAND)
        self._timer = SteadyTimer(self, parameters.rate_hz, self._publish)
        self.get_logger().info(f'Humanoid Joint Controller started ({parameters.rate_hz:g} Hz)')

    def _publish(self, now_s: float) -> None:
        """Publish the command for this moment."""
        stamp = self.get_clock().now().to_msg()
        self._publisher.publish(command_message(self._motion, now_s, stamp))

    def _change(self, parameters: JointControllerParameters) -> None:
        """Follow a change of the parameters."""
        self._motion = self._motion.followed_by(parameters.motion, self._timer.now_s())
        self._timer.set_rate(parameters.rate_hz)
        self.get_logger().info(f'Parameters changed: {parameters}')


def main() -> int:
    """Run the node."""
    return run_node(HumanoidJointController)


if __name__ == '__main__':
    sys.exit(main())
