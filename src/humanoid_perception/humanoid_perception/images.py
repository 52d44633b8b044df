# SPDX-License-Identifier: Apache-2.0
"""
Convert `sensor_msgs/Image` messages to arrays and back, without a copy where possible.

`cv_bridge` does not serve here: `8UC1` and `8UC3`, OpenCV's names of grey and BGR images, have no
colours for it, so that the detector would reject cameras that publish them; and what is wrong with
a message whose size does not match its data is told here in a sentence.
"""

from __future__ import annotations

from array import array
from typing import Any, Protocol

from humanoid_common.errors import UserError
from humanoid_perception.detection import Color, Depth
import numpy as np
import numpy.typing as npt

__all__ = ['ImageError', 'color_of', 'data_of', 'depth_of']

_COLORS = {'rgb8': (0, 1, 2), 'bgr8': (2, 1, 0), 'rgba8': (0, 1, 2), 'bgra8': (2, 1, 0)}
_CHANNELS = {'rgb8': 3, 'bgr8': 3, 'rgba8': 4, 'bgra8': 4, 'mono8': 1, '8UC1': 1, '8UC3': 3}
_DEPTHS = {'32FC1': ('f4', 1.0), '16UC1': ('u2', 0.001), 'mono16': ('u2', 0.001)}


class ImageError(UserError):
    """An image message cannot be used; the message states why, and what to do."""


class ImageMessage(Protocol):
    """The fields of a `sensor_msgs/Image`."""

    height: int
    width: int
    encoding: str
    is_bigendian: Any
    step: int
    data: Any


def color_of(image: ImageMessage) -> Color:
    """
    Convert an image message to an RGB array.

    Greyscale images get three equal channels. The array may share memory with the message: do not
    modify it.

    Parameters
    ----------
    image
        The message, in an encoding with 8 bits per channel.

    Returns
    -------
    Color
        The image (height, width, 3): red, green, blue.

    Raises
    ------
    ImageError
        Its encoding is not supported, or its size does not match its data.

    """
    channels = _CHANNELS.get(image.encoding)
    if channels is None:
        raise ImageError(
            f"The images have the encoding '{image.encoding}', but the detector needs one of "
            f'{", ".join(_CHANNELS)}. Configure the camera for one of these, or convert them.'
        )
    pixels = _rows(image, np.dtype(np.uint8), channels)
    if channels == 1:
        return np.repeat(pixels, 3, axis=2)
    order = _COLORS.get(image.encoding, (2, 1, 0))  # OpenCV's 8UC3 is blue, green, red
    return pixels[..., :3] if order == (0, 1, 2) and channels == 3 else pixels[..., list(order)]


def depth_of(image: ImageMessage) -> Depth:
    """
    Convert a depth image message to an array, according to REP 118.

    `32FC1` is in m; `16UC1` is in mm, where 0 means no measurement. NaN means no measurement,
    infinity means nothing within the range of the camera.

    Parameters
    ----------
    image
        The message of a depth camera.

    Returns
    -------
    Depth
        The depth (height, width) in m, along the optical axis; a copy.

    Raises
    ------
    ImageError
        Its encoding is not one of depth, or its size does not match its data.

    """
    if image.encoding not in _DEPTHS:
        raise ImageError(
            f"The depth images have the encoding '{image.encoding}', but must have 32FC1 (m) or "
            '16UC1 (mm), see REP 118. Configure the camera for one of these.'
        )
    kind, scale = _DEPTHS[image.encoding]
    dtype = np.dtype(('>' if image.is_bigendian else '<') + kind)
    depth = _rows(image, dtype, 1)[..., 0].astype(np.float32)
    if scale != 1.0:
        depth *= np.float32(scale)
    depth[~(depth > 0.0)] = np.nan
    return depth


def data_of(pixels: npt.NDArray[Any]) -> array[int]:
    """
    Convert pixels to an `array('B')`, which the `data` of an image message stores without a copy.

    Parameters
    ----------
    pixels
        The image, of any shape and type.

    Returns
    -------
    array
        The bytes, row by row without padding.

    """
    data = array('B')
    data.frombytes(np.ascontiguousarray(pixels).view(np.uint8).data.cast('B'))
    return data


def _rows(image: ImageMessage, dtype: np.dtype[Any], channels: int) -> npt.NDArray[Any]:
    """View the pixels (height, width, channels) of a message, without row padding."""
    row_bytes = image.width * channels * dtype.itemsize
    needed = image.step * (image.height - 1) + row_bytes
    if image.width < 1 or image.height < 1 or image.step < row_bytes:
        raise ImageError(
            f'An image of {image.width} x {image.height} pixels in {image.encoding} needs rows of '
            f'{row_bytes} bytes, but step is {image.step}. This is a bug in the camera driver.'
        )
    if len(image.data) < needed:
        raise ImageError(
            f'An image of {image.width} x {image.height} pixels in {image.encoding} needs '
            f'{needed} bytes, but has {len(image.data)}. This is a bug in the camera driver.'
        )
    data = np.frombuffer(image.data, np.uint8, needed)
    strides = (image.step, channels * dtype.itemsize, dtype.itemsize)
    shape = (image.height, image.width, channels)
    rows: npt.NDArray[Any] = np.ndarray(shape, dtype, data.data, 0, strides)
    return rows
