# SPDX-License-Identifier: Apache-2.0
"""The pixels of `sensor_msgs/msg/Image`, by encoding."""

from __future__ import annotations

import re
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ['Layout', 'layout_of', 'raw_pixels']

_COLORS = {'rgb': 3, 'bgr': 3, 'rgba': 4, 'bgra': 4, 'mono': 1}
_KINDS = {'U': 'u', 'S': 'i', 'F': 'f'}
_YUV = {
    'yuv422': 'uyvy',
    'uyvy': 'uyvy',
    'yuv422_yuy2': 'yuy2',
    'yuyv': 'yuy2',
}


class Layout(NamedTuple):
    """The layout of a pixel: the order of its colours, its channel count and data type."""

    order: str
    channels: int
    kind: np.dtype[Any]


def layout_of(encoding: str, is_bigendian: bool = False) -> Layout:
    """
    Parse an image encoding, such as `rgb8`, `16UC1` or `bayer_rggb8`.

    Parameters
    ----------
    encoding
        The encoding, as in `sensor_msgs/image_encodings`.
    is_bigendian
        Whether multi-byte values are big-endian.

    Raises
    ------
    ValueError
        The encoding is unknown.

    """
    end = '>' if is_bigendian else '<'
    if found := re.fullmatch(r'(rgb|bgr|rgba|bgra|mono)(8|16)', encoding):
        kind = np.dtype(f'{end}u{int(found[2]) // 8}')
        return Layout(found[1], _COLORS[found[1]], kind)
    if found := re.fullmatch(r'(8|16|32|64)([USF])C([134])?', encoding):
        size, channels = int(found[1]) // 8, int(found[3] or 1)
        if found[2] == 'F' and size < 4:
            raise _unknown(encoding)
        kind = np.dtype(f'{end}{_KINDS[found[2]]}{size}')
        return Layout({1: 'mono', 3: 'bgr', 4: 'bgra'}[channels], channels, kind)
    if found := re.fullmatch(r'bayer_(rggb|bggr|gbrg|grbg)(8|16)', encoding):
        return Layout(found[1], 1, np.dtype(f'{end}u{int(found[2]) // 8}'))
    if encoding in _YUV:
        return Layout(_YUV[encoding], 2, np.dtype('u1'))
    raise _unknown(encoding)


def raw_pixels(message: Any, layout: Layout) -> NDArray[Any]:
    """
    View the data of an image as an array, without a copy.

    Parameters
    ----------
    message
        The message, of the type `sensor_msgs/msg/Image`.
    layout
        The layout of its pixels.

    Returns
    -------
    NDArray[Any]
        The pixels (height, width, channels), of the type of the layout.

    Raises
    ------
    ValueError
        There are no pixels, or the rows or the data are too short.

    """
    width, height, step = message.width, message.height, message.step
    if not width or not height:
        raise ValueError(f'it has no pixels: it is {width} wide and {height} high.')
    pixel = layout.channels * layout.kind.itemsize
    if step < width * pixel:
        raise ValueError(
            f"its rows of {step} bytes are too short for {width} pixels of '{message.encoding}', "
            f'which need {width * pixel}.'
        )
    data = np.frombuffer(message.data, dtype=np.uint8)
    needed = step * (height - 1) + width * pixel
    if len(data) < needed:
        raise ValueError(
            f'it has {len(data)} bytes of data, but {height} rows of {step} bytes need '
            f'{step * height}.'
        )
    strides = (step, pixel, layout.kind.itemsize)
    pixels: NDArray[Any] = np.ndarray(
        (height, width, layout.channels), layout.kind, data, strides=strides
    )
    return pixels


def _unknown(encoding: str) -> ValueError:
    return ValueError(
        f"its encoding '{encoding}' is not known; known are rgb8, bgr8, rgba8, bgra8, mono8, "
        'mono16, 16UC1, 32FC1, yuv422, bayer_rggb8 and their like.'
    )
