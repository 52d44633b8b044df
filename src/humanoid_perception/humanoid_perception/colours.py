# SPDX-License-Identifier: Apache-2.0
"""
Name the colour of an object in an image.

Each pixel is classified as one of eleven colour names by its hue, saturation and value (HSV); the
most frequent name wins. Names depend mainly on the hue, so light and shadow have little effect.
White, grey or black parts of an object (a label, a lid, pages, a shadow) lose against a part with
a hue.
"""

from __future__ import annotations

import cv2
from humanoid_perception.detection import Box, Color, COLOURS
import numpy as np
import numpy.typing as npt

__all__ = ['CHROMATIC', 'colour_name', 'name_pixels']

_NAMES = tuple(COLOURS)
CHROMATIC = _NAMES[:-3]
"""The names of the colours with a hue; white, grey and black follow them in `COLOURS`."""
_NUMBER = {name: number for number, name in enumerate(_NAMES)}
_HUES = (
    # upper hue in degrees (red starts below 0), and the name of a bright and vivid colour
    (13.0, 'red'),
    (41.0, 'orange'),
    (68.0, 'yellow'),
    (172.0, 'green'),
    (258.0, 'blue'),
    (308.0, 'purple'),
    (338.0, 'pink'),
    (360.0, 'red'),
)
_LEAST_SATURATION, _LEAST_VALUE = 0.25, 0.16
_WHITE_VALUE, _BLACK_VALUE = 0.72, 0.22
_BROWN_VALUE = 0.58
_PINK_SATURATION, _PINK_VALUE = 0.62, 0.6
_LEAST_SHARE = 0.25
"""Smallest fraction of a colour with a hue; below it, the name is white, grey or black."""
_INNER = 0.9
"""Size of the ellipse whose pixels count, as a fraction of the box."""
_LEAST_PIXELS = 6
_MOST_EDGE_PX = 48


def name_pixels(pixels: Color) -> npt.NDArray[np.uint8]:
    """
    Classify the colour of each pixel by its hue, saturation and value (HSV).

    Parameters
    ----------
    pixels
        The image (height, width, 3): red, green, blue.

    Returns
    -------
    Array
        The index (height, width) of each pixel's name in `COLOURS`.

    """
    hsv = cv2.cvtColor(pixels.astype(np.float32) / np.float32(255.0), cv2.COLOR_RGB2HSV)
    hue, saturation, value = hsv[..., 0], hsv[..., 1], hsv[..., 2]
    ends = [end for end, _ in _HUES]
    names = np.array([_NUMBER[name] for _, name in (*_HUES, _HUES[-1])], dtype=np.uint8)
    named = names[np.searchsorted(ends, hue)]
    is_warm = (hue >= 8.0) & (hue < 50.0)
    named[is_warm & (value < _BROWN_VALUE)] = _NUMBER['brown']
    is_reddish = (hue > 308.0) | (hue < 8.0)
    is_pale = (saturation < _PINK_SATURATION) & (value > _PINK_VALUE)
    named[is_reddish & is_pale] = _NUMBER['pink']
    is_grey = (saturation < _LEAST_SATURATION) | (value < _LEAST_VALUE)
    greys = np.where(
        value > _WHITE_VALUE,
        _NUMBER['white'],
        np.where(value < _BLACK_VALUE, _NUMBER['black'], _NUMBER['grey']),
    ).astype(np.uint8)
    return np.where(is_grey, greys, named)


def colour_name(
    color: Color, box_px: Box, mask: npt.NDArray[np.bool_] | None = None
) -> tuple[str, float]:
    """
    Determine the name of an object's colour, and the fraction of its pixels with that colour.

    Parameters
    ----------
    color
        The image (height, width, 3): red, green, blue.
    box_px
        The box of the object.
    mask
        The pixels of the image that belong to the object (height, width), if known; otherwise
        those of the ellipse in the box count.

    Returns
    -------
    One of `COLOURS`, or '' if too few pixels are visible; and the fraction, 0 to 1.

    """
    height, width = color.shape[:2]
    left, right = (round(min(max(edge, 0.0), width)) for edge in (box_px[0], box_px[2]))
    top, bottom = (round(min(max(edge, 0.0), height)) for edge in (box_px[1], box_px[3]))
    if right - left < 2 or bottom - top < 2:
        return '', 0.0
    step = max(1, max(right - left, bottom - top) // _MOST_EDGE_PX)
    part = (slice(top, bottom, step), slice(left, right, step))
    named = name_pixels(np.ascontiguousarray(color[part]))
    inside = _ellipse(named.shape)
    if mask is not None and np.count_nonzero(mask[part] & inside) >= _LEAST_PIXELS:
        inside &= mask[part]
    counts = np.bincount(named[inside], minlength=len(_NAMES)).astype(np.float64)
    total = counts.sum()
    if total < _LEAST_PIXELS:
        return '', 0.0
    with_hue, without = np.split(counts, [len(CHROMATIC)])
    best = int(with_hue.argmax())
    if with_hue[best] < _LEAST_SHARE * total:
        best = len(CHROMATIC) + int(without.argmax())
    return _NAMES[best], float(counts[best] / total)


def _ellipse(shape: tuple[int, ...]) -> npt.NDArray[np.bool_]:
    """Compute the mask (height, width) of the inner ellipse of a box."""
    rows = (np.arange(shape[0]) + 0.5) / shape[0] * 2.0 - 1.0
    columns = (np.arange(shape[1]) + 0.5) / shape[1] * 2.0 - 1.0
    return np.asarray(rows[:, None] ** 2 + columns[None, :] ** 2 <= _INNER**2)
