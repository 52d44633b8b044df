# SPDX-License-Identifier: Apache-2.0
"""
Listener that fills a buffer with published transforms.

Messages are deserialized without message objects: rclpy takes 0.3 ms for a message with 23
transforms, which a listener would spend on each message. As a broadcaster always sends the same
names, all numbers are at the same offsets.
"""

from __future__ import annotations

from functools import partial
import struct
import threading
from typing import Any, Optional, TYPE_CHECKING, Union
import weakref

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.serialization import deserialize_message
from tf2_msgs.msg import TFMessage
from tf2_py.messages import Reading, reading_of
from tf2_ros.transform_broadcaster import DYNAMIC, STATIC_LISTENER

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.qos import QoSProfile
    from tf2_py import BufferCore

_AUTHORITY = 'default_authority'
_JOIN_TIMEOUT_S = 10.0

_NS_PER_S = 10**9
_ORDERS = {b'\x00\x00': '>', b'\x00\x01': '<'}
_MAX_LAYOUTS = 100
_FIELDS = 13  # per transform: the stamp, two names with their lengths, and seven numbers
_BEGIN = 16  # offset of the first name, after the encapsulation header, the count and a stamp


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
        self._background = _Background(node) if spin_thread else None

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
        self.buffer.insert_readings(reader.read(data), _AUTHORITY, is_static)

    def _forget_at_jumps(self) -> None:
        """Make a Buffer monitor the clock of the node; a BufferCore has no clock."""
        follow = getattr(self.buffer, 'follow_clock_of', None)
        if follow is not None:
            follow(self.node)


class _Background:
    """
    Spins a node in a thread until it is stopped or the program ends.

    Parameters
    ----------
    node
        The node to spin, with its own executor.

    Attributes
    ----------
    stop
        Callable that ends the thread and shuts the executor down; also runs when this object
        is garbage collected.

    """

    def __init__(self, node: Node) -> None:
        executor = SingleThreadedExecutor(context=node.context)
        executor.add_node(node)
        stop = threading.Event()
        thread = threading.Thread(
            target=_spin, args=(executor, stop), name='transform listener', daemon=True
        )
        thread.start()
        self.stop = weakref.finalize(self, _stop, executor, stop, thread)


def _spin(executor: SingleThreadedExecutor, stop: threading.Event) -> None:
    try:
        while not stop.is_set():
            executor.spin_once()
    except ExternalShutdownException:
        pass


def _stop(
    executor: SingleThreadedExecutor, stop: threading.Event, thread: threading.Thread
) -> None:
    """End the thread before the executor: rclpy's fails if it is shut down while spinning."""
    stop.set()
    if thread is not threading.current_thread():
        executor.create_task(lambda: None)  # wakes up the executor
        thread.join(_JOIN_TIMEOUT_S)
        executor.shutdown(0.0)


class TfReader:
    """Deserializer of `tf2_msgs/TFMessage` with a cache of message layouts."""

    def __init__(self) -> None:
        """Create a reader with an empty cache of layouts."""
        self._layouts: dict[tuple[int, bytes], _Layout] = {}

    def read(self, data: bytes) -> list[Reading]:
        """
        Deserialize a `tf2_msgs/TFMessage` to plain numbers.

        Parameters
        ----------
        data
            The serialized message (CDR).

        Returns
        -------
        list of Reading
            For each transform: parent frame, child frame, stamp in ns, and pose of the child.

        """
        try:
            return self._read(data)
        except (IndexError, KeyError, struct.error, UnicodeDecodeError):
            message = deserialize_message(data, TFMessage)
            return [reading_of(transform) for transform in message.transforms]

    def _read(self, data: bytes) -> list[Reading]:
        order = _ORDERS[data[:2]]
        end = _end_of_names(data, order)
        key = len(data), data[_BEGIN:end]
        layout = self._layouts.get(key)
        readings = layout.read(data) if layout is not None else None
        if readings is not None:
            return readings
        if len(self._layouts) >= _MAX_LAYOUTS:
            self._layouts.clear()
        layout = self._layouts[key] = _Layout(data, order)
        return layout.read(data) or []


def _end_of_names(data: bytes, order: str) -> int:
    """Return the offset after the names of the first transform, which distinguish robots."""
    (parent,) = struct.unpack_from(f'{order}I', data, _BEGIN)
    child_at = _BEGIN + _aligned(4 + parent, 4)
    (child,) = struct.unpack_from(f'{order}I', data, child_at)
    return child_at + 4 + int(child)


class _Layout:
    """Offsets of the numbers in messages with the same frame names."""

    def __init__(self, data: bytes, order: str) -> None:
        """Determine the layout of a message."""
        (count,) = struct.unpack_from(f'{order}I', data, 4)
        parts, at = [order, '4xI'], 4
        texts: list[bytes] = []
        for _ in range(count):
            parts.append(f'{_aligned(at, 4) - at}xiI')
            at = _aligned(at, 4) + 8
            for _ in range(2):
                begin = _aligned(at, 4)
                (length,) = struct.unpack_from(f'{order}I', data, 4 + begin)
                parts.append(f'{begin - at}xI{length}s')
                (text,) = struct.unpack_from(f'{length}s', data, 8 + begin)
                at = begin + 4 + length
                texts.append(text)
            parts.append(f'{_aligned(at, 8) - at}x7d')
            at = _aligned(at, 8) + 56
        self._unpack = struct.Struct(''.join(parts)).unpack_from
        parents, children = texts[::2], texts[1::2]
        self._given = tuple(tuple(map(len, each)) for each in (parents, children))
        self._texts = tuple(parents), tuple(children)
        self._names = list(zip(map(_name, parents), map(_name, children)))

    def read(self, data: bytes) -> list[Reading] | None:
        """Return the transforms of a message, or None if its frame names differ."""
        values = self._unpack(data)
        given = values[3::_FIELDS], values[5::_FIELDS]
        texts = values[4::_FIELDS], values[6::_FIELDS]
        if values[0] != len(self._names) or given != self._given or texts != self._texts:
            return None
        stamps = zip(values[1::_FIELDS], values[2::_FIELDS])
        poses = zip(*(values[at::_FIELDS] for at in range(7, 14)))
        return [
            (parent, child, seconds * _NS_PER_S + nanoseconds, pose)
            for (parent, child), (seconds, nanoseconds), pose in zip(self._names, stamps, poses)
        ]


def _name(text: bytes) -> str:
    return text.rstrip(b'\0').decode()


def _aligned(at: int, size: int) -> int:
    return (at + size - 1) // size * size
