# SPDX-License-Identifier: Apache-2.0
"""Decoding of `sensor_msgs/msg/CompressedImage`."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
from rviz_default_plugins.decoding.brightness import Brightness
from rviz_default_plugins.decoding.images import Picture, step_for

__all__ = ['decode_compressed_image']

MOST_COMPRESSED = 100_000_000
"""The maximum number of pixels; larger images may be decompression bombs."""


def decode_compressed_image(message: Any, brightness: Brightness) -> Picture:
    """
    Decode a JPEG or PNG of `sensor_msgs/msg/CompressedImage`, small enough for a page.

    Parameters
    ----------
    message
        The message.
    brightness
        Maps images of 16 or 32 bits to greys.

    Raises
    ------
    ValueError
        The image is too large, broken or of another format, such as a compressed depth image.

    """
    from PIL import Image, UnidentifiedImageError

    if 'compressedDepth' in message.format:
        raise ValueError(
            f"its format is '{message.format}', which has a depth image inside; show the topic of "
            'the raw depth image.'
        )
    try:
        with Image.open(io.BytesIO(bytes(message.data)), formats=('JPEG', 'PNG')) as opened:
            return _small(opened, brightness)
    except UnidentifiedImageError:
        raise ValueError(
            f"its {len(message.data)} bytes with the format '{message.format}' are neither a JPEG "
            'nor a PNG.'
        ) from None
    except (OSError, SyntaxError, Image.DecompressionBombError) as error:
        raise ValueError(f'it is broken: {error}.') from None


def _small(opened: Any, brightness: Brightness) -> Picture:
    """Decode an opened image, downsampled for the page."""
    width, height = opened.size
    if width * height > MOST_COMPRESSED:
        raise ValueError(f'it is too great with {width} x {height} pixels.')
    step = step_for(width, height)
    opened.draft(None, (width // step, height // step))  # JPEG can be decoded at a reduced size
    left = max(1, round(step * opened.size[0] / width))
    if opened.mode in ('I', 'I;16', 'I;16B', 'F'):
        gray = brightness.apply(np.asarray(opened)[::left, ::left])
        return Picture(np.repeat(gray[:, :, None], 3, axis=2), step)
    return Picture(np.asarray(opened.convert('RGB'))[::left, ::left], step)
