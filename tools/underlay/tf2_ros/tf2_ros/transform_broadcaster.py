# SPDX-License-Identifier: Apache-2.0
"""Broadcaster for transforms of moving frames, and the QoS profiles of `/tf` and `/tf_static`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Optional, TYPE_CHECKING, Union

from geometry_msgs.msg import TransformStamped
from rclpy.qos import DurabilityPolicy, QoSProfile
from tf2_msgs.msg import TFMessage

if TYPE_CHECKING:
    from rclpy.node import Node

# A robot has many broadcasters; a slow listener must not lose their messages.
DYNAMIC = QoSProfile(depth=100)
# Late joiners receive the last message of each publisher.
STATIC_LISTENER = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
# Each message holds all static transforms of its publisher.
STATIC_BROADCASTER = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)

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
