# SPDX-License-Identifier: Apache-2.0
"""The transport `compressed`: images as JPEG or PNG in `sensor_msgs/CompressedImage`."""

from __future__ import annotations

from dataclasses import dataclass

from image_transport.encodings import Pixels
from image_transport.pixels import (
    bytes_of,
    ENCODINGS,
    image_of,
    packed,
    pixels_of,
    unpacked,
)
import numpy as np
from sensor_msgs.msg import CompressedImage, Image

__all__ = ['CompressedSettings', 'decode_compressed', 'encode_compressed']

GREY_PARTS = np.array([0.299, 0.587, 0.114])
"""What red, green and blue contribute to grey (BT.601, as in JPEG)."""


@dataclass(frozen=True)
class CompressedSettings:
    """The parameters of the transport `compressed`."""

    format: str = 'jpeg'
    """'jpeg' or 'png'."""
    jpeg_quality: int = 95
    """From 1 to 100."""
    png_level: int = 3
    """How hard PNG compresses, from 0 to 9; it is lossless at each level."""


def encode_compressed(
    image: Image, settings: CompressedSettings = CompressedSettings()
) -> CompressedImage:
    """
    Compress an image as JPEG or PNG.

    Parameters
    ----------
    image
        The image. What is not opaque becomes opaque, as in the genuine transport.
    settings
        The format and its quality or level.

    Returns
    -------
    CompressedImage
        With the same header, and a format such as 'rgb8; jpeg compressed bgr8'.

    Raises
    ------
    ValueError
        The format cannot hold images of this encoding, or the image is broken.

    """
    encoding = ENCODINGS.get(image.encoding)
    kinds = ('u1',) if settings.format == 'jpeg' else ('u1', 'u2')
    if encoding is None or encoding.kind not in kinds:
        able = ', '.join(name for name, each in ENCODINGS.items() if each.kind in kinds)
        raise ValueError(
            f"Images with the encoding '{image.encoding}' cannot be compressed as "
            f'{settings.format}, which takes {able}. {_advice(image.encoding)}'
        )
    pixels = pixels_of(image)
    if encoding.order:
        pixels = pixels[:, :, list(encoding.order)]
    if settings.format == 'jpeg':
        data = packed(pixels, 'JPEG', quality=settings.jpeg_quality)
    else:
        data = packed(pixels.astype(encoding.kind), 'PNG', compress_level=settings.png_level)
    return CompressedImage(
        header=image.header,
        format=f'{image.encoding}; {settings.format} compressed {"bgr8" * bool(encoding.order)}',
        data=bytes_of(data),
    )


def _advice(encoding: str) -> str:
    if encoding in ('16UC1', 'mono16'):
        return "Set the format to png, or use the transport 'compressedDepth' for depths."
    if encoding == '32FC1':
        return "Use the transport 'compressedDepth'."
    return 'Configure the camera for one of these, or convert the images first.'


def decode_compressed(message: CompressedImage) -> Image:
    """
    Decompress a JPEG or PNG.

    Parameters
    ----------
    message
        The message; whether its data are a JPEG or a PNG is seen from them.

    Returns
    -------
    Image
        With the same header, and the encoding that the format names before the semicolon. Without
        a known one it is `bgr8`, or for greys `mono8` or `mono16`.

    Raises
    ------
    ValueError
        The data are neither, or are broken.

    """
    pixels = unpacked(bytes(message.data))
    name = message.format.partition(';')[0].strip()
    encoding = ENCODINGS.get(name)
    if encoding is None or encoding.kind != pixels.dtype.str[1:]:
        name = 'bgr8' if pixels.ndim == 3 else f'mono{8 * pixels.itemsize}'
        encoding = ENCODINGS[name]
    if not encoding.order:
        return image_of(_grey(pixels), name, message.header)
    return image_of(_in_order(pixels, encoding.channels, encoding.order), name, message.header)


def _grey(pixels: Pixels) -> Pixels:
    if pixels.ndim == 2:
        return pixels
    grey: Pixels = np.rint(pixels @ GREY_PARTS).astype(np.uint8)
    return grey


def _in_order(pixels: Pixels, channels: int, order: tuple[int, ...]) -> Pixels:
    """Bring red, green and blue, or grey, into the order of an encoding; alpha is opaque."""
    ordered = np.full((*pixels.shape[:2], channels), 255, np.uint8)
    ordered[:, :, list(order)] = pixels if pixels.ndim == 3 else pixels[:, :, None]
    return ordered
