# SPDX-License-Identifier: Apache-2.0
"""Decoding of `sensor_msgs/msg/Image` to RGB, downsampled for the page."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from rviz_default_plugins.decoding.brightness import Brightness
from rviz_default_plugins.decoding.pixels import Layout, layout_of, raw_pixels

__all__ = ['MOST_PIXELS', 'Picture', 'decode_image', 'step_for']

Bytes = NDArray[np.uint8]

MOST_PIXELS = 1_300_000
"""The maximum number of pixels that are shown; larger images are downsampled."""


class Picture(NamedTuple):
    """Rows of RGB pixels; each stands for `step` pixels in both directions."""

    pixels: Bytes
    step: int = 1


def step_for(width: int, height: int) -> int:
    """
    Compute the step of downsampling at which about `MOST_PIXELS` of an image remain, or less.

    Parameters
    ----------
    width, height
        The size of the image in pixels.

    Returns
    -------
    int
        n to keep every n-th row and column; 1 to keep all.

    """
    return max(1, math.ceil(math.sqrt(width * height / MOST_PIXELS)))


def decode_image(message: Any, brightness: Brightness) -> Picture:
    """
    Decode `sensor_msgs/msg/Image` to red, green and blue, small enough for a page.

    Parameters
    ----------
    message
        The message.
    brightness
        Maps images of one channel, such as depths, to greys; not used for 8 unsigned bits.

    Raises
    ------
    ValueError
        The encoding is unknown, the image is empty or too small for it, or data is missing.

    """
    layout = layout_of(message.encoding, bool(message.is_bigendian))
    raw = raw_pixels(message, layout)
    step = step_for(message.width, message.height)
    if layout.order in ('uyvy', 'yuy2'):
        return Picture(_from_yuv(raw[::step], layout.order)[:, ::step], step)
    if len(layout.order) == 4 and layout.channels == 1 and layout.order != 'mono':
        return _from_bayer(raw[:, :, 0], layout, step)
    return Picture(_from_colors(raw[::step, ::step], layout, brightness), step)


def _from_colors(raw: NDArray[Any], layout: Layout, brightness: Brightness) -> Bytes:
    if layout.order == 'mono':
        gray = raw[:, :, 0]
        # Eight-bit values are displayed as they are; depths and the like have no fixed range.
        shown = gray if layout.kind == np.uint8 else brightness.apply(gray)
        return np.repeat(shown[:, :, None], 3, axis=2)
    colors = _eight_bits(raw)
    return colors[:, :, 2::-1] if layout.order.startswith('bgr') else colors[:, :, :3]


def _eight_bits(raw: NDArray[Any]) -> Bytes:
    """Convert numbers of any type to bytes."""
    if raw.dtype.kind == 'f':
        shown = np.clip(np.nan_to_num(raw), 0.0, 1.0) * 255.0
    else:
        shown = np.maximum(raw, 0) >> 8 * (raw.dtype.itemsize - 1)
    small: Bytes = shown.astype(np.uint8)
    return small


def _from_bayer(raw: NDArray[Any], layout: Layout, step: int) -> Picture:
    """Return one RGB pixel per 2 x 2 block of the Bayer pattern."""
    height, width = (length // 2 * 2 for length in raw.shape)
    if not height or not width:
        raise ValueError('it is too small for a Bayer pattern, which has squares of 2 x 2 pixels.')
    squares = raw[:height, :width]
    corners = [squares[row::2, column::2] for row in (0, 1) for column in (0, 1)]
    half = max(1, -(-step // 2))
    small = [_eight_bits(corner[::half, ::half]) for corner in corners]
    green = np.mean([each for each, color in zip(small, layout.order) if color == 'g'], axis=0)
    red, blue = (small[layout.order.index(color)] for color in 'rb')
    shown = np.stack([red, green.astype(np.uint8), blue], axis=2)
    return Picture(shown, 2 * half if half > 1 else 1)


def _from_yuv(raw: Bytes, order: str) -> Bytes:
    """Convert YUV 4:2:2 pixels to RGB (BT.601, as used by cameras)."""
    width = raw.shape[1] // 2 * 2
    if not width:
        raise ValueError('it is one pixel wide, but its encoding has pixels in twos.')
    bright, color = (1, 0) if order == 'uyvy' else (0, 1)
    y = raw[:, :width, bright].astype(np.float32) - 16.0
    u = np.repeat(raw[:, 0:width:2, color], 2, axis=1).astype(np.float32) - 128.0
    v = np.repeat(raw[:, 1:width:2, color], 2, axis=1).astype(np.float32) - 128.0
    red = 1.164 * y + 1.596 * v
    green = 1.164 * y - 0.392 * u - 0.813 * v
    blue = 1.164 * y + 2.017 * u
    colors: Bytes = np.clip(np.stack([red, green, blue], axis=2), 0, 255).round().astype(np.uint8)
    return colors
