# SPDX-License-Identifier: Apache-2.0
"""Read the pixels of images."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

__all__ = ['to_bgr']

_ENCODINGS: dict[str, tuple[int, int | None]] = {
    'bgr8': (3, None),
    '8UC3': (3, None),
    'rgb8': (3, cv2.COLOR_RGB2BGR),
    'bgra8': (4, cv2.COLOR_BGRA2BGR),
    'rgba8': (4, cv2.COLOR_RGBA2BGR),
    'mono8': (1, None),
    '8UC1': (1, None),
}


def to_bgr(data: Any, height: int, width: int, step: int, encoding: str) -> npt.NDArray[np.uint8]:
    """
    Convert an image to the pixel format that OpenCV writes.

    Parameters
    ----------
    data
        The bytes, row by row.
    height, width
        The size in pixels.
    step
        The number of bytes per row.
    encoding
        As in `sensor_msgs/Image`, such as rgb8.

    Returns
    -------
    numpy.ndarray
        (height, width, 3) blue, green, red, or (height, width) grey.

    Raises
    ------
    ValueError
        The encoding is not supported, or the data are too short.

    """
    if encoding not in _ENCODINGS:
        raise ValueError(f"images of the encoding '{encoding}' cannot be read")
    channels, conversion = _ENCODINGS[encoding]
    values = np.frombuffer(bytes(data), np.uint8)
    if step < width * channels or len(values) < height * step:
        raise ValueError('the image has too few bytes for its size')
    rows = values[: height * step].reshape(height, step)[:, : width * channels]
    pixels = rows.reshape((height, width) if channels == 1 else (height, width, channels))
    if conversion is None:
        return pixels
    return np.asarray(cv2.cvtColor(np.ascontiguousarray(pixels), conversion), np.uint8)
