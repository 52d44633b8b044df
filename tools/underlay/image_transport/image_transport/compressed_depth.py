# SPDX-License-Identifier: Apache-2.0
"""
The transport `compressedDepth`: depth images as PNG behind a header of 12 bytes.

The header is three little-endian numbers of 4 bytes: the kind of quantisation (0), and its
parameters A and B. Depths in m (`32FC1`) are stored as the integers A / depth + B, which are exact
near the camera and coarse far away; 0 stands for no measurement. Depths in mm (`16UC1`) are
stored as they are.
"""

from __future__ import annotations

from dataclasses import dataclass
import struct

from image_transport.encodings import Pixels
from image_transport.pixels import bytes_of, image_of, packed, pixels_of, unpacked
import numpy as np
from sensor_msgs.msg import CompressedImage, Image

__all__ = ['DepthSettings', 'decode_compressed_depth', 'encode_compressed_depth']

HEADER = struct.Struct('<iff')
INVERSE_DEPTH = 0
LARGEST = 65535
MM = 1000.0


@dataclass(frozen=True)
class DepthSettings:
    """The parameters of the transport `compressedDepth`."""

    format: str = 'png'
    """Only 'png'."""
    depth_max: float = 10.0
    """The largest depth in m; what is farther away counts as no measurement."""
    depth_quantization: float = 100.0
    """The depth in m at which the resolution of `32FC1` images is about 1 m."""
    png_level: int = 3
    """How hard PNG compresses, from 0 to 9."""


def encode_compressed_depth(
    image: Image, settings: DepthSettings = DepthSettings()
) -> CompressedImage:
    """
    Compress a depth image.

    Parameters
    ----------
    image
        The image, with the encoding `32FC1` in m or `16UC1` in mm.
    settings
        The range, the quantisation, and how hard PNG compresses.

    Returns
    -------
    CompressedImage
        With the same header, and the format '32FC1; compressedDepth png' or the like.

    Raises
    ------
    ValueError
        The image has another encoding, or is broken.

    """
    if image.encoding == '16UC1':
        a, b = 0.0, 0.0
        depths_mm = pixels_of(image)
        stored = np.where(depths_mm <= settings.depth_max * MM, depths_mm, 0).astype(np.uint16)
    elif image.encoding == '32FC1':
        a = settings.depth_quantization * (settings.depth_quantization + 1.0)
        b = 1.0 - a / settings.depth_max
        stored = _quantised(pixels_of(image), a, b, settings.depth_max)
    else:
        raise ValueError(
            f"Images with the encoding '{image.encoding}' are not depth images: "
            "compressedDepth takes 16UC1 and 32FC1. Use the transport 'compressed' for colours "
            'and greys.'
        )
    data = packed(stored, 'PNG', compress_level=settings.png_level)
    return CompressedImage(
        header=image.header,
        format=f'{image.encoding}; compressedDepth png',
        data=bytes_of(HEADER.pack(INVERSE_DEPTH, a, b) + data),
    )


def _quantised(depths_m: Pixels, a: float, b: float, depth_max: float) -> Pixels:
    """Return A / depth + B; depths that are too small for 16 bits become the smallest possible."""
    is_measured = (depths_m > 0.0) & (depths_m < depth_max)
    safe = np.where(is_measured, depths_m, depth_max).astype(np.float64)
    return np.where(is_measured, np.clip(np.rint(a / safe + b), 1, LARGEST), 0).astype(np.uint16)


def decode_compressed_depth(message: CompressedImage) -> Image:
    """
    Decompress a depth image.

    Parameters
    ----------
    message
        The message, whose format begins with '32FC1' or '16UC1'.

    Returns
    -------
    Image
        With the same header. What was not measured is NaN in `32FC1` and 0 in `16UC1`.

    Raises
    ------
    ValueError
        The format is another one, such as rvl, or the data are broken.

    """
    encoding, _, rest = (part.strip() for part in message.format.partition(';'))
    if encoding not in ('16UC1', '32FC1') or rest not in (
        'compressedDepth',
        'compressedDepth png',
    ):
        raise ValueError(
            f"The format '{message.format}' is not supported: it must be '16UC1; compressedDepth "
            "png' or '32FC1; compressedDepth png'. Set the publisher's parameter format to png."
        )
    data = bytes(message.data)
    if len(data) < HEADER.size:
        raise ValueError(
            f'{len(data)} bytes of data are too few: the header alone has {HEADER.size}.'
        )
    _, a, b = HEADER.unpack_from(data)
    stored = unpacked(data[HEADER.size :], ('PNG',))
    if stored.ndim != 2 or stored.dtype != np.uint16:
        raise ValueError('The PNG after the header does not have one channel of 16 bits.')
    if encoding == '16UC1':
        return image_of(stored, encoding, message.header)
    span = np.where(stored > 0, stored - np.float64(b), np.nan)
    with np.errstate(divide='ignore'):
        return image_of(a / span, encoding, message.header)
