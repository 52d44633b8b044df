# SPDX-License-Identifier: Apache-2.0
"""What the encodings of `sensor_msgs/Image` mean, and the data of an image as an array."""

from __future__ import annotations

import re
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ['Encoding', 'Pixels', 'parse_encoding', 'view_pixels']

Pixels = NDArray[Any]

_COLOURS = {'rgb': 3, 'bgr': 3, 'rgba': 4, 'bgra': 4, 'mono': 1}
_YUV = {'uyvy': 'uyvy', 'yuv422': 'uyvy', 'yuyv': 'yuy2', 'yuv422_yuy2': 'yuy2'}
_KINDS = {'U': 'u', 'S': 'i', 'F': 'f'}


class Encoding(NamedTuple):
    """
    The layout of a pixel.

    colours: 'rgb', 'bgr', 'rgba', 'bgra' or 'mono'; the first square of a Bayer pattern, such as
    'rggb'; 'uyvy' or 'yuy2'; or '' for numbers of any meaning, such as those of `32FC1`. kind: the
    NumPy type of a channel without byte order, such as 'u1'.
    """

    colours: str
    channels: int
    kind: str

    @property
    def type_name(self) -> str:
        """The name of the type of a pixel in OpenCV, such as '8UC3'."""
        return f'{8 * int(self.kind[1:])}{_letter(self.kind)}C{self.channels}'


def parse_encoding(name: str) -> Encoding:
    """
    Parse the name of an encoding, such as `rgb8`, `16UC1`, `bayer_rggb8` or `yuv422`.

    Parameters
    ----------
    name
        The name, as in `sensor_msgs/image_encodings`.

    Raises
    ------
    ValueError
        The encoding is unknown.

    """
    if found := re.fullmatch(r'(rgb|bgr|rgba|bgra|mono)(8|16)', name):
        return Encoding(found[1], _COLOURS[found[1]], f'u{int(found[2]) // 8}')
    if found := re.fullmatch(r'bayer_(rggb|bggr|gbrg|grbg)(8|16)', name):
        return Encoding(found[1], 1, f'u{int(found[2]) // 8}')
    if found := re.fullmatch(r'(8U|8S|16U|16S|32S|32F|64F)(?:C([1-9]\d{0,2})?)?', name):
        size, letter = int(found[1][:-1]) // 8, found[1][-1]
        return Encoding('', int(found[2] or 1), f'{_KINDS[letter]}{size}')
    if name in _YUV:
        return Encoding(_YUV[name], 2, 'u1')
    raise ValueError(
        f"The encoding '{name}' is not supported; supported are rgb8, bgr8, rgba8, bgra8, mono8, "
        'the same with 16 instead of 8, 8UC1 to 64FC4, bayer_rggb8 and similar, and yuv422.'
    )


def view_pixels(image: Any, encoding: Encoding) -> Pixels:
    """
    View the data of an image as an array, without a copy.

    Parameters
    ----------
    image
        The message, a `sensor_msgs/Image`.
    encoding
        The layout of its pixels.

    Returns
    -------
    Pixels
        The pixels (height, width), or (height, width, channels) in the order of the encoding, in
        the byte order of the message and without the padding of its rows.

    Raises
    ------
    ValueError
        The image is empty, or has fewer data than its size needs.

    """
    kind = np.dtype(f'{">" if image.is_bigendian else "<"}{encoding.kind}')
    width, height, step = image.width, image.height, image.step
    row = width * encoding.channels * kind.itemsize
    data = np.frombuffer(image.data, np.uint8)
    if not width or not height or step < row or len(data) < step * (height - 1) + row:
        raise ValueError(
            f'An image of {width} x {height} pixels ({image.encoding}) with rows of {step} bytes '
            f'has {len(data)} bytes of data: its size and its data do not match.'
        )
    channels = () if encoding.channels == 1 else (encoding.channels,)
    strides = (step, encoding.channels * kind.itemsize, kind.itemsize)[: 2 + len(channels)]
    pixels: Pixels = np.ndarray((height, width, *channels), kind, data, strides=strides)
    return pixels


def _letter(kind: str) -> str:
    return next(letter for letter, each in _KINDS.items() if each == kind[0])
