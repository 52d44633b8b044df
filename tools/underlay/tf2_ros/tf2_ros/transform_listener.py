# SPDX-License-Identifier: Apache-2.0
"""Listener that fills a buffer with published transforms."""

from __future__ import annotations

from functools import partial
from typing import Any, Optional, TYPE_CHECKING, Union

from rclpy.callback_groups import ReentrantCallbackGroup
from tf2_msgs.msg import TFMessage
from tf2_ros._background import Background
from tf2_ros._qos import DYNAMIC, STATIC_LISTENER
from tf2_ros._tf_bytes import TfReader

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.qos import QoSProfile
    from tf2_py import BufferCore

_AUTHORITY = 'default_authority'


class TransformListener:
    """
    Subscribes to `/tf` and `/tf_static` and inserts the transforms into a buffer.

    Parameters
    ----------
    buffer
        The buffer to fill; a `Buffer` also monitors the clock of the node.
    node
        The node that subscribes.
    spin_thread
        Whether to spin the node in its own thread.
    qos
        The QoS profile for `/tf`; by default reliable with a depth of 100.
    static_qos
        The QoS profile for `/tf_static`; by default also transient local.
    static_only
        Whether to subscribe to `/tf_static` only.

    Attributes
    ----------
    tf_sub, tf_static_sub
        The subscriptions; None if not subscribed.
    group
        The callback group of the subscriptions.

    """

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
        self.buffer = buffer
        self.node = node
        self.group = self._group()
        self._reader = TfReader() if self._is_plain() else None
        self.tf_sub: Any = None
        if not static_only:
            self.tf_sub = self._subscribe('/tf', False, DYNAMIC if qos is None else qos)
        self.tf_static_sub: Any = self._subscribe(
            '/tf_static', True, STATIC_LISTENER if static_qos is None else static_qos
        )
        self._forget_at_jumps()
        self._background = Background(node) if spin_thread else None

    def callback(self, data: TFMessage) -> None:
        """
        Insert the transforms of moving frames into the buffer.

        Subclasses may override this to receive the messages of `/tf`.

        Parameters
        ----------
        data
            The message of `/tf`.

        """
        for transform in data.transforms:
            self.buffer.set_transform(transform, _AUTHORITY)

    def static_callback(self, data: TFMessage) -> None:
        """
        Insert static transforms into the buffer.

        Subclasses may override this to receive the messages of `/tf_static`.

        Parameters
        ----------
        data
            The message of `/tf_static`.

        """
        for transform in data.transforms:
            self.buffer.set_transform_static(transform, _AUTHORITY)

    def unregister(self) -> None:
        """Destroy the subscriptions and end the thread."""
        if self._background is not None:
            self._background.stop()
            self._background = None
        for subscription in (self.tf_sub, self.tf_static_sub):
            if subscription is not None:
                self.node.destroy_subscription(subscription)
        self.tf_sub = self.tf_static_sub = None

    def _group(self) -> ReentrantCallbackGroup:
        """Create the callback group of the subscriptions."""
        return ReentrantCallbackGroup()

    def _is_plain(self) -> bool:
        """Whether nothing is overridden, so that messages need not be deserialized by rclpy."""
        from tf2_py import BufferCore

        names = 'set_transform', 'set_transform_static'
        return (
            isinstance(self.buffer, BufferCore)
            and all(
                getattr(type(self.buffer), each) is getattr(BufferCore, each) for each in names
            )
            and type(self).callback is TransformListener.callback
            and type(self).static_callback is TransformListener.static_callback
        )

    def _subscribe(self, topic: str, is_static: bool, qos: Union[QoSProfile, int]) -> Any:
        callback: Any = self.static_callback if is_static else self.callback
        if self._reader is not None:
            callback = partial(self._take, self._reader, is_static)
        return self.node.create_subscription(
            TFMessage,
            topic,
            callback,
            qos,
            callback_group=self.group,
            raw=self._reader is not None,
        )

    def _take(self, reader: TfReader, is_static: bool, data: bytes) -> None:
        """Insert the transforms of a serialized message into the buffer."""
        self.buffer._take(reader.read(data), _AUTHORITY, is_static)

    def _forget_at_jumps(self) -> None:
        """Make a Buffer monitor the clock of the node; a BufferCore has no clock."""
        follow = getattr(self.buffer, 'follow_clock_of', None)
        if follow is not None:
            follow(self.node)
