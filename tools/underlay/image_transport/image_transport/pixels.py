# SPDX-License-Identifier: Apache-2.0
"""Images of ROS as arrays and back, and arrays as JPEG and PNG and back."""

from __future__ import annotations

from array import array
import io
from typing import Any, NamedTuple

from image_transport.encodings import parse_encoding, Pixels, view_pixels
import numpy as np
from PIL import Image as Pillow
from PIL import UnidentifiedImageError
from sensor_msgs.msg import Image

__all__ = ['ENCODINGS', 'Layout', 'bytes_of', 'image_of', 'packed', 'pixels_of', 'unpacked']


class Layout(NamedTuple):
    """The layout of a pixel: its channels, their type, and red, green and blue among them."""

    channels: int
    kind: str
    order: tuple[int, ...] = ()


_RGB, _BGR = (0, 1, 2), (2, 1, 0)
_ORDERS = {'rgb8': _RGB, 'bgr8': _BGR, 'rgba8': _RGB, 'bgra8': _BGR, '8UC3': _BGR}
_GREYS = ('mono8', '8UC1', 'mono16', '16UC1', '32FC1')
ENCODINGS = {
    name: Layout(encoding.channels, encoding.kind, _ORDERS.get(name, ()))
    for name in (*_ORDERS, *_GREYS)
    for encoding in (parse_encoding(name),)
}
"""The encodings that transports understand; as in OpenCV, `8UC3` is blue, green and red."""


def pixels_of(image: Image) -> Pixels:
    """
    View the data of an image as an array, without a copy.

    Parameters
    ----------
    image
        The message; its encoding is one of `ENCODINGS`.

    Returns
    -------
    Pixels
        The pixels (height, width), or (height, width, channels) in the order of the encoding.

    Raises
    ------
    ValueError
        The image is empty, or has fewer data than its size needs.

    """
    return view_pixels(image, parse_encoding(image.encoding))


def image_of(pixels: Pixels, encoding: str, header: Any) -> Image:
    """
    Create an image from an array.

    Parameters
    ----------
    pixels
        The pixels (height, width), or (height, width, channels) in the order of the encoding.
    encoding
        One of `ENCODINGS`.
    header
        The header of the message.

    """
    height, width = pixels.shape[:2]
    little = np.ascontiguousarray(pixels, np.dtype(f'<{ENCODINGS[encoding].kind}'))
    return Image(
        header=header,
        height=height,
        width=width,
        encoding=encoding,
        step=little.nbytes // height,
        data=bytes_of(little.tobytes()),
    )


def bytes_of(data: bytes) -> array[int]:
    """
    Convert data to the type that messages take without checking each byte.

    Parameters
    ----------
    data
        The data of an image.

    """
    numbers = array('B')
    numbers.frombytes(data)
    return numbers


def packed(pixels: Pixels, form: str, **options: int) -> bytes:
    """
    Compress an array.

    Parameters
    ----------
    pixels
        Greys (height, width) of 8 or 16 bits, or red, green and blue (height, width, 3).
    form
        'JPEG' or 'PNG'.
    **options
        Those of Pillow for the form: `quality` or `compress_level`.

    """
    stream = io.BytesIO()
    Pillow.fromarray(np.ascontiguousarray(pixels)).save(stream, form, **options)
    return stream.getvalue()


def unpacked(data: bytes, forms: tuple[str, ...] = ('JPEG', 'PNG')) -> Pixels:
    """
    Decompress a JPEG or PNG.

    Parameters
    ----------
    data
        The data of the file.
    forms
        The accepted forms.

    Returns
    -------
    Pixels
        Greys (height, width) of 8 or 16 bits, or red, green and blue (height, width, 3).

    Raises
    ------
    ValueError
        It is neither, is broken, or is so large that it may be a decompression bomb.

    """
    try:
        with Pillow.open(io.BytesIO(data), formats=forms) as opened:
            if opened.mode.startswith('I'):
                return np.asarray(opened).astype(np.uint16)
            return np.asarray(opened.convert('L' if opened.mode in ('1', 'L') else 'RGB'))
    except UnidentifiedImageError:
        raise ValueError(f'{len(data)} bytes of data are no {" or ".join(forms)}.') from None
    except (OSError, SyntaxError, Pillow.DecompressionBombError) as error:
        raise ValueError(f'The compressed data are broken: {error}.') from None
