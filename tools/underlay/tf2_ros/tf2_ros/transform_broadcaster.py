# SPDX-License-Identifier: Apache-2.0
"""Broadcaster for transforms of moving frames."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Optional, TYPE_CHECKING, Union

from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage
from tf2_ros._qos import DYNAMIC

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.qos import QoSProfile

Transforms = Union[TransformStamped, Iterable[TransformStamped]]


class TransformBroadcaster:
    """
    Publishes transforms on `/tf`.

    Parameters
    ----------
    node
        The node that publishes.
    qos
        The QoS profile; by default reliable with a depth of 100.

    Attributes
    ----------
    pub_tf
        The publisher.

    """

    def __init__(self, node: Node, qos: Optional[Union[QoSProfile, int]] = None) -> None:
        self.pub_tf = node.create_publisher(TFMessage, '/tf', DYNAMIC if qos is None else qos)

    def sendTransform(self, transform: Transforms) -> None:  # noqa: N802
        """
        Publish transforms of moving frames in one message.

        Parameters
        ----------
        transform
            One or several transforms: the pose of the child frame in the header frame at a time.

        """
        self.pub_tf.publish(TFMessage(transforms=as_list(transform)))


def as_list(transforms: Transforms) -> list[TransformStamped]:
    """
    Convert one or several transforms to a list.

    Parameters
    ----------
    transforms
        A `TransformStamped`, or an iterable of them.

    """
    return [transforms] if isinstance(transforms, TransformStamped) else list(transforms)
