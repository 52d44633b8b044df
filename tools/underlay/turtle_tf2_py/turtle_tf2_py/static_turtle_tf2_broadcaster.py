# SPDX-License-Identifier: Apache-2.0
"""A node that broadcasts a static frame, which its command line places in `world`."""

from __future__ import annotations

from collections.abc import Sequence
import math
import sys
from typing import Any

from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros import StaticTransformBroadcaster
from tf2_ros.program import run_node
from tf_transformations import quaternion_from_euler

__all__ = ['StaticFramePublisher', 'main', 'transform_from_words']

WORLD = 'world'
USAGE = (
    'Usage: ros2 run turtle_tf2_py static_turtle_tf2_broadcaster '
    'child_frame_name x y z roll pitch yaw'
)


class StaticFramePublisher(Node):
    """
    Broadcasts a static transform once.

    Parameters
    ----------
    transform
        The transform; its time is set here.
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, transform: TransformStamped, **options: Any) -> None:
        super().__init__('static_turtle_tf2_broadcaster', **options)
        self.tf_static_broadcaster = StaticTransformBroadcaster(self)
        transform.header.stamp = self.get_clock().now().to_msg()
        self.tf_static_broadcaster.sendTransform(transform)


def transform_from_words(words: Sequence[str]) -> TransformStamped:
    """
    Build the transform that a command line describes.

    Parameters
    ----------
    words
        The name of the frame, its position in m, and its roll, pitch and yaw in rad.

    Raises
    ------
    ValueError
        Words are missing or no numbers, or the frame has no name or is `world` itself.

    """
    if len(words) != 7:
        raise ValueError(f'There are {len(words)} arguments instead of 7.\n{USAGE}')
    child, *numbers = words
    if not child:
        raise ValueError(f'The name of the frame is empty.\n{USAGE}')
    if child == WORLD:
        raise ValueError(f"The frame cannot be '{WORLD}': that is its parent.\n{USAGE}")
    x, y, z, roll, pitch, yaw = (_number(word) for word in numbers)
    transform = TransformStamped()
    transform.header.frame_id, transform.child_frame_id = WORLD, child
    translation = transform.transform.translation
    translation.x, translation.y, translation.z = x, y, z
    rotation = transform.transform.rotation
    rotation.x, rotation.y, rotation.z, rotation.w = map(
        float, quaternion_from_euler(roll, pitch, yaw)
    )
    return transform


def _number(word: str) -> float:
    try:
        number = float(word)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise ValueError(f"'{word}' is not a number.\n{USAGE}")
    return number


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda words: StaticFramePublisher(transform_from_words(words)), args)


if __name__ == '__main__':
    sys.exit(main())
