# SPDX-License-Identifier: Apache-2.0
"""The program; the node is imported once signals are deferred."""

from __future__ import annotations

import sys

from tf2_ros.program import run

__all__ = ['main']


def main() -> int:
    """Run the program; return the exit status."""
    return run(list, _work)


def _work(words: list[str]) -> int:
    from rclpy.exceptions import ParameterException
    from robot_state_publisher.node_arguments import unknown_overrides
    from teleop_twist_keyboard.node import teleoperate, TeleopNode

    def make() -> TeleopNode:
        node = TeleopNode()
        for sentence in unknown_overrides(node):
            node.get_logger().warning(sentence)
        return node

    if words:
        sys.stderr.write(
            f'teleop_twist_keyboard takes no arguments, but was given: {" ".join(words)}. '
            'Pass parameters after --ros-args -p.\n'
        )
        return 1
    try:
        return teleoperate(make)
    except (ValueError, ParameterException) as error:
        sys.stderr.write(f'{error}\n')
        return 1
