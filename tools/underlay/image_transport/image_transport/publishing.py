# SPDX-License-Identifier: Apache-2.0
"""A publisher of images over several transports, with their parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from copy import copy
from dataclasses import fields
from typing import Any, TYPE_CHECKING, TypeVar

from image_transport.compressed import CompressedSettings, encode_compressed
from image_transport.compressed_depth import DepthSettings, encode_compressed_depth
from image_transport.transports import check_transport, DEPTH, QUIET_S, topic_of, TRANSPORTS
from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    SetParametersResult,
)
from rclpy.event_handler import PublisherEventCallbacks
from rclpy.qos import QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.parameter import Parameter
    from rclpy.publisher import Publisher
    from sensor_msgs.msg import Image

__all__ = ['ImagePublisher']

SettingsT = TypeVar('SettingsT', CompressedSettings, DepthSettings)

DESCRIPTIONS = {
    'format': 'How images are compressed.',
    'jpeg_quality': 'Quality of JPEG: 100 is the best, and the largest.',
    'png_level': 'How hard PNG compresses: 0 is the fastest, 9 the smallest; all are lossless.',
    'depth_max': 'Largest depth in m; what is farther away counts as no measurement.',
    'depth_quantization': 'Depth in m at which the resolution of 32FC1 images is about 1 m.',
}
RANGES = {
    'jpeg_quality': (1, 100),
    'png_level': (0, 9),
    'depth_max': (1.0, 100.0),
    'depth_quantization': (1.0, 150.0),
}
FORMATS = {'compressed': ('jpeg', 'png'), 'compressedDepth': ('png',)}


class ImagePublisher:
    """
    Publishes images over several transports; each compresses only while somebody listens to it.

    The parameters of the node are those of the official plugins, such as
    `camera.image_raw.compressed.jpeg_quality` for the topic `camera/image_raw`. They can be
    changed at any time.

    Parameters
    ----------
    node
        The node that publishes.
    topic
        The image topic; `/compressed` and `/compressedDepth` are appended for these transports.
    transports
        Their names; by default those of the parameter `<image>.enable_pub_plugins`, which are
        all unless it is given.
    qos
        By default reliable, with a queue of `DEPTH`. Parameters `qos_overrides` apply.
    on_match
        Called when a subscriber has come or gone.

    Raises
    ------
    ValueError
        There is no such transport.

    """

    def __init__(
        self,
        node: Node,
        topic: str,
        transports: Iterable[str] | None = None,
        qos: QoSProfile | None = None,
        on_match: Callable[[], None] = lambda: None,
    ) -> None:
        self._node = node
        base = _parameter_base(node, topic)
        if transports is None:
            name = f'{base}.enable_pub_plugins'
            every = [f'image_transport/{each}' for each in TRANSPORTS]
            transports = node.declare_parameter(
                name, every, ParameterDescriptor(description='Transports.', read_only=True)
            ).value
        names = [check_transport(each) for each in transports]
        self._encoders = {each: _encoder(node, base, each) for each in names}
        self._publishers: dict[str, Publisher] = {
            each: node.create_publisher(
                TRANSPORTS[each].message_type,
                topic_of(node, topic, each),
                copy(qos) if qos else QoSProfile(depth=DEPTH),  # overrides change it
                event_callbacks=PublisherEventCallbacks(matched=lambda _: on_match()),
                qos_overriding_options=QoSOverridingOptions.with_default_policies(),
            )
            for each in names
        }

    def topics(self) -> list[str]:
        """Return the full names of the topics, in the order of the transports."""
        return [str(each.topic_name) for each in self._publishers.values()]

    def subscription_count(self) -> int:
        """Return the number of subscribers over all transports."""
        return sum(each.get_subscription_count() for each in self._publishers.values())

    def publish(self, image: Image) -> None:
        """
        Send an image over each transport that somebody listens to.

        Parameters
        ----------
        image
            The image. Where it cannot be compressed it is left out, and the log says why.

        """
        for transport, publisher in self._publishers.items():
            if not publisher.get_subscription_count():
                continue
            try:
                message = self._encoders[transport](image)
            except ValueError as error:
                self._node.get_logger().warning(
                    f'An image is not published on {publisher.topic_name}: {error}',
                    throttle_duration_sec=QUIET_S,
                )
                continue
            publisher.publish(message)


def _parameter_base(node: Node, topic: str) -> str:
    """
    Return the beginning of the names of a topic's parameters.

    It is the name of the topic after the node's namespace, with dots. In a namespace other than
    the root it begins with a dot, as in the genuine package. Remappings do not change it.
    """
    full = str(node.resolve_topic_name(topic, only_expand=True))
    return full.removeprefix(node.get_namespace()).replace('/', '.')


def _encoder(node: Node, base: str, transport: str) -> Callable[[Image], Any]:
    """Declare the parameters of a transport; return what compresses an image by them."""
    if transport == 'raw':
        return lambda image: image
    prefix = f'{base}.{transport}'
    node.add_on_set_parameters_callback(_format_check(f'{prefix}.format', FORMATS[transport]))
    if transport == 'compressed':
        read = _declared(node, prefix, CompressedSettings)
        return lambda image: encode_compressed(image, read())
    read_depth = _declared(node, prefix, DepthSettings)
    return lambda image: encode_compressed_depth(image, read_depth())


def _declared(node: Node, prefix: str, kind: type[SettingsT]) -> Callable[[], SettingsT]:
    """Declare the settings of a transport as parameters; return what reads them."""
    names = [each.name for each in fields(kind)]
    for name, default in vars(kind()).items():
        node.declare_parameter(f'{prefix}.{name}', default, _descriptor(name))
    return lambda: kind(**{name: node.get_parameter(f'{prefix}.{name}').value for name in names})


def _descriptor(name: str) -> ParameterDescriptor:
    descriptor = ParameterDescriptor(description=DESCRIPTIONS[name])
    low, high = RANGES.get(name, (None, None))
    if isinstance(low, int):
        descriptor.integer_range = [IntegerRange(from_value=low, to_value=high, step=1)]
    elif low is not None:
        descriptor.floating_point_range = [FloatingPointRange(from_value=low, to_value=high)]
    return descriptor


def _format_check(
    name: str, formats: tuple[str, ...]
) -> Callable[[list[Parameter]], SetParametersResult]:
    """Return a callback that refuses formats that a transport does not have."""

    def check(changes: list[Parameter]) -> SetParametersResult:
        for change in changes:
            if change.name == name and change.value not in formats:
                return SetParametersResult(
                    successful=False,
                    reason=f"'{change.value}' is not supported: use {' or '.join(formats)}.",
                )
        return SetParametersResult(successful=True)

    return check
