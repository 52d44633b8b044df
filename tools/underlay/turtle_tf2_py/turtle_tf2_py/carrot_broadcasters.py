# SPDX-License-Identifier: Apache-2.0
"""Nodes that add the frame `carrot1` to the first turtle: at its side, or going around it."""

from __future__ import annotations

from collections.abc import Sequence
import math
from typing import Any

from rclpy.node import Node
from tf2_ros import TransformBroadcaster
from tf2_ros.program import run_node
from turtle_tf2_py.turtle_frames import planar_transform

__all__ = ['DynamicFrameBroadcaster', 'FixedFrameBroadcaster', 'run_dynamic', 'run_fixed']

TURTLE, CARROT = 'turtle1', 'carrot1'
PERIOD_S = 0.1
ASIDE_M = 2.0
RADIUS_M = 10.0
RATE_RAD_S = math.pi


class FixedFrameBroadcaster(Node):
    """
    Broadcasts `carrot1` two metres to the left of `turtle1`.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('fixed_frame_tf2_broadcaster', **options)
        self.tf_broadcaster = TransformBroadcaster(self)
        self.create_timer(PERIOD_S, self.broadcast_timer_callback)

    def broadcast_timer_callback(self) -> None:
        """Broadcast the transform."""
        stamp = self.get_clock().now().to_msg()
        self.tf_broadcaster.sendTransform(planar_transform(TURTLE, CARROT, stamp, 0.0, ASIDE_M))


class DynamicFrameBroadcaster(Node):
    """
    Broadcasts `carrot1` on a circle around `turtle1`.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('dynamic_frame_tf2_broadcaster', **options)
        self.tf_broadcaster = TransformBroadcaster(self)
        self.create_timer(PERIOD_S, self.broadcast_timer_callback)

    def broadcast_timer_callback(self) -> None:
        """Broadcast the transform of this moment."""
        now = self.get_clock().now()
        angle = RATE_RAD_S * (now.nanoseconds / 1e9 % (2.0 * math.pi / RATE_RAD_S))
        x, y = RADIUS_M * math.sin(angle), RADIUS_M * math.cos(angle)
        self.tf_broadcaster.sendTransform(planar_transform(TURTLE, CARROT, now.to_msg(), x, y))


def run_fixed(args: Sequence[str] | None = None) -> int:
    """
    Run the node with the fixed frame; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: FixedFrameBroadcaster(), args)


def run_dynamic(args: Sequence[str] | None = None) -> int:
    """
    Run the node with the moving frame; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        As for `run_fixed`.

    """
    return run_node(lambda _: DynamicFrameBroadcaster(), args)
