# SPDX-License-Identifier: Apache-2.0
"""Broadcaster for static transforms."""

from __future__ import annotations

from copy import deepcopy
from typing import Optional, TYPE_CHECKING, Union

from tf2_msgs.msg import TFMessage
from tf2_ros.transform_broadcaster import as_list, STATIC_BROADCASTER, Transforms

if TYPE_CHECKING:
    from geometry_msgs.msg import TransformStamped
    from rclpy.node import Node
    from rclpy.qos import QoSProfile


class StaticTransformBroadcaster:
    """
    Publishes transforms on `/tf_static`, which late subscribers receive as well.

    Parameters
    ----------
    node
        The node that publishes.
    qos
        The QoS profile; by default reliable and transient local with a depth of 1.

    Attributes
    ----------
    pub_tf
        The publisher.

    """

    def __init__(self, node: Node, qos: Optional[Union[QoSProfile, int]] = None) -> None:
        chosen = STATIC_BROADCASTER if qos is None else qos
        self.pub_tf = node.create_publisher(TFMessage, '/tf_static', chosen)
        self._transforms: dict[str, TransformStamped] = {}

    def sendTransform(self, transform: Transforms) -> None:  # noqa: N802
        """
        Publish static transforms, together with all transforms sent before.

        Parameters
        ----------
        transform
            One or several transforms; each replaces an earlier one with the same child frame.

        """
        # The caller may reuse the same message.
        sent = deepcopy(as_list(transform))
        self._transforms.update({item.child_frame_id: item for item in sent})
        self.pub_tf.publish(TFMessage(transforms=list(self._transforms.values())))
