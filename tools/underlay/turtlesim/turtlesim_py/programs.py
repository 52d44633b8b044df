# SPDX-License-Identifier: Apache-2.0
"""Main functions of the programs; nodes are imported once signals are deferred."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
import sys
from typing import TYPE_CHECKING

from tf2_ros.program import run, run_node

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['run_draw_square', 'run_mimic', 'run_teleop', 'run_turtlesim']


def run_turtlesim() -> int:
    """Run turtlesim_node; return the exit status."""

    def make() -> Node:
        from turtlesim_py.turtlesim_node import TurtlesimNode

        return TurtlesimNode()

    return run_node(partial(_checked, 'turtlesim_node', make))


def run_draw_square() -> int:
    """Run draw_square; return the exit status."""

    def make() -> Node:
        from turtlesim_py.draw_square import DrawSquareNode

        return DrawSquareNode()

    return run_node(partial(_checked, 'draw_square', make))


def run_mimic() -> int:
    """Run mimic; return the exit status."""

    def make() -> Node:
        from turtlesim_py.mimic import MimicNode

        return MimicNode()

    return run_node(partial(_checked, 'mimic', make))


def run_teleop() -> int:
    """Run turtle_teleop_key; return the exit status."""

    def work(words: list[str]) -> int:
        from rclpy.exceptions import ParameterException
        from turtlesim_py.teleop import teleoperate, TeleopNode

        try:
            return teleoperate(lambda: _checked('turtle_teleop_key', TeleopNode, words))
        except (ValueError, ParameterException) as error:
            sys.stderr.write(f'{error}\n')
            return 1

    return run(list, work)


def _checked(program: str, make: Callable[[], Node], words: list[str]) -> Node:
    """Create a node, and warn of parameters that it does not have."""
    from robot_state_publisher.node_arguments import unknown_overrides

    if words:
        raise ValueError(
            f'{program} takes no arguments, but was given: {" ".join(words)}. '
            'Pass parameters after --ros-args -p.'
        )
    node = make()
    for sentence in unknown_overrides(node):
        node.get_logger().warning(sentence)
    return node
