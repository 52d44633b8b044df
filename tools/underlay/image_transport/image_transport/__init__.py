# SPDX-License-Identifier: Apache-2.0
"""Publish and receive images, raw or compressed, as `image_transport` of ROS 2 does."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from image_transport.compressed import (
        CompressedSettings,
        decode_compressed,
        encode_compressed,
    )
    from image_transport.compressed_depth import (
        decode_compressed_depth,
        DepthSettings,
        encode_compressed_depth,
    )
    from image_transport.publishing import ImagePublisher
    from image_transport.transports import subscribe_to_images

__all__ = [
    'CompressedSettings',
    'DepthSettings',
    'ImagePublisher',
    'decode_compressed',
    'decode_compressed_depth',
    'encode_compressed',
    'encode_compressed_depth',
    'subscribe_to_images',
]

__getattr__, __dir__ = lazy_exports(
    __name__,
    __all__,
    {
        'CompressedSettings': 'compressed',
        'DepthSettings': 'compressed_depth',
        'ImagePublisher': 'publishing',
        'decode_compressed': 'compressed',
        'decode_compressed_depth': 'compressed_depth',
        'encode_compressed': 'compressed',
        'encode_compressed_depth': 'compressed_depth',
        'subscribe_to_images': 'transports',
    },
)
