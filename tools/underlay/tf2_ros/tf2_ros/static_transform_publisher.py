# SPDX-License-Identifier: Apache-2.0
"""Publish a static transform: `ros2 run tf2_ros static_transform_publisher`."""

from __future__ import annotations

import random
import string
import sys
from typing import TYPE_CHECKING

from tf2_ros._static_arguments import OLD_STYLE_WARNING, parsed, StaticTransform
from tf2_ros.program import run, spin

if TYPE_CHECKING:
    from geometry_msgs.msg import TransformStamped
    from rclpy.node import Node


def main() -> int:
    """Run the program; return the exit status."""
    return run(parsed, _publish)


def _publish(transform: StaticTransform) -> None:
    """Publish the transform until the program is stopped."""
    from rclpy.node import Node
    from tf2_ros.static_transform_broadcaster import StaticTransformBroadcaster

    letters = ''.join(random.choices(string.ascii_letters + string.digits, k=16))
    node = Node(f'static_transform_publisher_{letters}')
    if transform.is_old_style:
        node.get_logger().warning(OLD_STYLE_WARNING)
    StaticTransformBroadcaster(node).sendTransform(_message(transform, node))
    node.get_logger().info(_report(transform))
    spin(node)


def _message(transform: StaticTransform, node: Node) -> TransformStamped:
    from geometry_msgs.msg import TransformStamped

    message = TransformStamped(child_frame_id=transform.child_frame_id)
    message.header.frame_id = transform.frame_id
    message.header.stamp = node.get_clock().now().to_msg()
    place, turn = message.transform.translation, message.transform.rotation
    place.x, place.y, place.z = transform.translation
    turn.x, turn.y, turn.z, turn.w = transform.rotation
    return message


def _report(transform: StaticTransform) -> str:
    translation = ', '.join(f"'{number:f}'" for number in transform.translation)
    rotation = ', '.join(f"'{number:f}'" for number in transform.rotation)
    return (
        'Spinning until stopped - publishing transform\n'
        f'translation: ({translation})\n'
        f'rotation: ({rotation})\n'
        f"from '{transform.frame_id}' to '{transform.child_frame_id}'"
    )


if __name__ == '__main__':
    sys.exit(main())
