# SPDX-License-Identifier: Apache-2.0
"""Which transports there are, on which topics they send, and how images are received over one."""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
from typing import Any, NamedTuple, TYPE_CHECKING

from image_transport.compressed import decode_compressed
from image_transport.compressed_depth import decode_compressed_depth
from rclpy.qos import QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions
from ros_environment.suggestions import did_you_mean
from sensor_msgs.msg import CompressedImage, Image

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.subscription import Subscription

__all__ = [
    'DEPTH',
    'QUIET_S',
    'TRANSPORTS',
    'Transport',
    'check_transport',
    'subscribe_to_images',
    'topic_of',
]

DEPTH = 10
"""The depth of the queues, as in the genuine package; topics are reliable."""
QUIET_S = 10.0
"""How long a warning about images of one kind is not repeated."""


class Transport(NamedTuple):
    """A way to send images: its messages, and what its publisher and its subscriber do."""

    message_type: type
    decode: Callable[[Any], Image]
    publisher: str
    subscriber: str


TRANSPORTS = {
    'compressed': Transport(
        CompressedImage,
        decode_compressed,
        'Compresses images as JPEG or PNG.',
        'Decompresses JPEG and PNG.',
    ),
    'compressedDepth': Transport(
        CompressedImage,
        decode_compressed_depth,
        'Compresses depth images (16UC1, 32FC1) as PNG.',
        'Decompresses depth images.',
    ),
    'raw': Transport(
        Image,
        lambda image: image,
        'Sends images unchanged.',
        'Receives images unchanged.',
    ),
}


def check_transport(name: str) -> str:
    """
    Check the name of a transport.

    Parameters
    ----------
    name
        The name, as given by a user; `image_transport/` may stand before it.

    Returns
    -------
    str
        The name without what may stand before it.

    Raises
    ------
    ValueError
        There is no such transport.

    """
    short = name.removeprefix('image_transport/')
    if short not in TRANSPORTS:
        raise ValueError(
            f"There is no image transport '{name}'; there are {', '.join(TRANSPORTS)}. "
            f'{did_you_mean(short, TRANSPORTS, ignore_case=True)}'.rstrip()
        )
    return short


def topic_of(node: Node, topic: str, transport: str) -> str:
    """
    Find the topic on which images are sent over a transport.

    Parameters
    ----------
    node
        The node, whose namespace and remappings apply. A remapping of the transport's topic, such
        as that of `in/compressed`, goes before one of the image topic `in`.
    topic
        The image topic.
    transport
        The name of the transport.

    Returns
    -------
    str
        The full name, such as `/camera/image_raw/compressed`; for `raw` that of the image topic.

    """
    base = str(node.resolve_topic_name(topic))
    if transport == 'raw':
        return base
    name = f'{topic}/{transport}'
    remapped = str(node.resolve_topic_name(name))
    if remapped != node.resolve_topic_name(name, only_expand=True):
        return remapped
    return f'{base}/{transport}'


def subscribe_to_images(
    node: Node,
    topic: str,
    callback: Callable[[Image], None],
    transport: str = 'raw',
    qos: QoSProfile | None = None,
) -> Subscription:
    """
    Receive images over a transport.

    What cannot be decompressed is left out, and the log says why.

    Parameters
    ----------
    node
        The node that subscribes. Its parameters `qos_overrides` apply.
    topic
        The image topic, without the name of the transport.
    callback
        Called with each image.
    transport
        The name of the transport.
    qos
        By default reliable, with a queue of `DEPTH`.

    Raises
    ------
    ValueError
        There is no such transport.

    """
    transport = check_transport(transport)
    message_type, decode, *_ = TRANSPORTS[transport]
    name = topic_of(node, topic, transport)

    def receive(message: Any) -> None:
        try:
            image = decode(message)
        except ValueError as error:
            node.get_logger().warning(
                f'An image on {name} is skipped: {error}', throttle_duration_sec=QUIET_S
            )
            return
        callback(image)

    return node.create_subscription(
        message_type,
        name,
        receive,
        copy(qos) if qos else QoSProfile(depth=DEPTH),  # overrides change it
        qos_overriding_options=QoSOverridingOptions.with_default_policies(),
    )
