# SPDX-License-Identifier: Apache-2.0
"""How messages with images are decoded to RGB: raw, compressed or of depth, and downsampled."""

from __future__ import annotations

from collections import deque
import io
import math
from statistics import median
from typing import Any, NamedTuple

from image_transport.encodings import parse_encoding
import numpy as np
from numpy.typing import NDArray

__all__ = ['MOST_PIXELS', 'Brightness', 'Picture', 'decode_compressed_image', 'decode_image']

Bytes = NDArray[np.uint8]

MOST_PIXELS = 1_300_000
"""The maximum number of pixels that are shown; larger images are downsampled."""

MOST_COMPRESSED = 100_000_000
"""The maximum number of pixels; larger images may be decompression bombs."""

_ORDERS = {1: 'mono', 3: 'bgr', 4: 'bgra'}  # of numbers without a meaning, as in OpenCV


class Picture(NamedTuple):
    """Rows of RGB pixels; each stands for `step` pixels in both directions."""

    pixels: Bytes
    step: int = 1


def _step_for(width: int, height: int) -> int:
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
    layout = _layout_of(message.encoding, bool(message.is_bigendian))
    raw = _raw_pixels(message, layout)
    step = _step_for(message.width, message.height)
    if layout.order in ('uyvy', 'yuy2'):
        return Picture(_from_yuv(raw[::step], layout.order)[:, ::step], step)
    if len(layout.order) == 4 and layout.channels == 1 and layout.order != 'mono':
        return _from_bayer(raw[:, :, 0], layout, step)
    return Picture(_from_colors(raw[::step, ::step], layout, brightness), step)


def _from_colors(raw: NDArray[Any], layout: _Layout, brightness: Brightness) -> Bytes:
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


def _from_bayer(raw: NDArray[Any], layout: _Layout, step: int) -> Picture:
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
        raise ValueError('it is one pixel wide, but its encoding stores pixels in pairs.')
    bright, color = (1, 0) if order == 'uyvy' else (0, 1)
    y = raw[:, :width, bright].astype(np.float32) - 16.0
    u = np.repeat(raw[:, 0:width:2, color], 2, axis=1).astype(np.float32) - 128.0
    v = np.repeat(raw[:, 1:width:2, color], 2, axis=1).astype(np.float32) - 128.0
    red = 1.164 * y + 1.596 * v
    green = 1.164 * y - 0.392 * u - 0.813 * v
    blue = 1.164 * y + 2.017 * u
    colors: Bytes = np.clip(np.stack([red, green, blue], axis=2), 0, 255).round().astype(np.uint8)
    return colors


def decode_compressed_image(message: Any, brightness: Brightness) -> Picture:
    """
    Decode `sensor_msgs/msg/CompressedImage`, small enough for a page: JPEG, PNG or depths.

    Parameters
    ----------
    message
        The message.
    brightness
        Maps images of 16 or 32 bits to greys.

    Raises
    ------
    ValueError
        The image is too large, broken or of another format.

    """
    from PIL import Image, UnidentifiedImageError

    if 'compressedDepth' in message.format:
        from image_transport import decode_compressed_depth

        return decode_image(decode_compressed_depth(message), brightness)
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
        raise ValueError(f'it is too large with {width} x {height} pixels.')
    step = _step_for(width, height)
    opened.draft(None, (width // step, height // step))  # JPEG can be decoded at a reduced size
    left = max(1, round(step * opened.size[0] / width))
    if opened.mode in ('I', 'I;16', 'I;16B', 'F'):
        gray = brightness.apply(np.asarray(opened)[::left, ::left])
        return Picture(np.repeat(gray[:, :, None], 3, axis=2), step)
    return Picture(np.asarray(opened.convert('RGB'))[::left, ::left], step)


class _Layout(NamedTuple):
    """The layout of a pixel: the order of its colours, its channel count and data type."""

    order: str
    channels: int
    kind: np.dtype[Any]


def _layout_of(encoding: str, is_bigendian: bool = False) -> _Layout:
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
    try:
        found = parse_encoding(encoding)
        order = found.colours or _ORDERS[found.channels]
    except (ValueError, KeyError):
        raise _unknown(encoding) from None
    kind = np.dtype(f'{">" if is_bigendian else "<"}{found.kind}')
    return _Layout(order, found.channels, kind)


def _raw_pixels(message: Any, layout: _Layout) -> NDArray[Any]:
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
        f"its encoding '{encoding}' is not supported; supported are rgb8, bgr8, rgba8, bgra8, "
        'mono8, mono16, 16UC1, 32FC1, yuv422, bayer_rggb8 and similar encodings.'
    )


class Brightness:
    """
    Maps values to greys between limits, which may be determined from the last images.

    Parameters
    ----------
    limits
        The values mapped to black and white; None to determine them from the images.
    window
        The number of images over whose minima and maxima the medians are taken as limits.

    """

    def __init__(self, limits: tuple[float, float] | None = None, window: int = 5) -> None:
        self._limits = limits
        self._seen: deque[tuple[float, float]] = deque(maxlen=max(1, window))

    def apply(self, values: NDArray[Any]) -> NDArray[np.uint8]:
        """
        Map the values of an image to greys.

        Parameters
        ----------
        values
            An array of any shape. Without fixed limits, its minimum and maximum enter the medians.

        Returns
        -------
        NDArray[np.uint8]
            Greys of the same shape. Non-finite values are black, and all values are if the limits
            are equal.

        """
        numbers = values.astype(np.float32)
        finite = np.isfinite(numbers)
        low, high = self._limits or self._found(numbers[finite])
        span = high - low
        if span == 0.0 or not np.isfinite(span):
            return np.zeros(values.shape, dtype=np.uint8)
        parts = np.where(finite, (np.where(finite, numbers, low) - low) / span, 0.0)
        return (np.clip(parts, 0.0, 1.0) * 255.0).astype(np.uint8)

    def _found(self, numbers: NDArray[np.float32]) -> tuple[float, float]:
        if numbers.size:
            self._seen.append((float(numbers.min()), float(numbers.max())))
        if not self._seen:
            return 0.0, 0.0
        return median(low for low, _ in self._seen), median(high for _, high in self._seen)
