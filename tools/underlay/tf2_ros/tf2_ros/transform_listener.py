# SPDX-License-Identifier: Apache-2.0
"""Fill a buffer with what is published."""

from __future__ import annotations

from typing import Any, Optional, TYPE_CHECKING, Union

from rclpy.callback_groups import ReentrantCallbackGroup
from tf2_msgs.msg import TFMessage
from tf2_ros._background import Background
from tf2_ros._qos import DYNAMIC, STATIC_LISTENER

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.qos import QoSProfile
    from tf2_py import BufferCore

_AUTHORITY = 'default_authority'


class TransformListener:
    """Subscribes `/tf` and `/tf_static`, and hands the transforms to a buffer."""

    def __init__(
        self,
        buffer: BufferCore,
        node: Node,
        *,
        spin_thread: bool = False,
        qos: Optional[Union[QoSProfile, int]] = None,
        static_qos: Optional[Union[QoSProfile, int]] = None,
        static_only: bool = False,
    ) -> None:
        """
        Subscribe.

        :param buffer: what is filled
        :param node: the node that subscribes
        :param spin_thread: let the node work in a thread of its own
        :param qos: another QoS for `/tf` than the usual one, reliable with a depth of 100
        :param static_qos: another one for `/tf_static`, transient local as well
        :param static_only: leave `/tf` out
        """
        self.buffer = buffer
        self.node = node
        self.group = ReentrantCallbackGroup()
        self.tf_sub: Any = None
        if not static_only:
            self.tf_sub = self._subscribe('/tf', self.callback, DYNAMIC if qos is None else qos)
        self.tf_static_sub: Any = self._subscribe(
            '/tf_static',
            self.static_callback,
            STATIC_LISTENER if static_qos is None else static_qos,
        )
        self._forget_at_jumps()
        self._background = Background(node) if spin_thread else None

    def callback(self, data: TFMessage) -> None:
        """Take the transforms of frames that move."""
        for transform in data.transforms:
            self.buffer.set_transform(transform, _AUTHORITY)

    def static_callback(self, data: TFMessage) -> None:
        """Take transforms that hold at all times."""
        for transform in data.transforms:
            self.buffer.set_transform_static(transform, _AUTHORITY)

    def unregister(self) -> None:
        """Subscribe no longer, and end the thread."""
        if self._background is not None:
            self._background.stop()
            self._background = None
        for subscription in (self.tf_sub, self.tf_static_sub):
            if subscription is not None:
                self.node.destroy_subscription(subscription)
        self.tf_sub = self.tf_static_sub = None

    def _subscribe(self, topic: str, callback: Any, qos: Union[QoSProfile, int]) -> Any:
        return self.node.create_subscription(
            TFMessage, topic, callback, qos, callback_group=self.group
        )

    def _forget_at_jumps(self) -> None:
        """Let a Buffer know the clock of the node; a BufferCore knows no clocks."""
        follow = getattr(self.buffer, 'follow_clock_of', None)
        if follow is not None:
            follow(self.node)
