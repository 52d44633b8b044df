# SPDX-License-Identifier: Apache-2.0
"""Between which encodings images are converted, and how."""

from __future__ import annotations

from typing import Any

from image_transport.encodings import Encoding, parse_encoding, Pixels
import numpy as np

__all__ = ['CvBridgeError', 'convert', 'encoding_of', 'opencv']

_NAMES = {
    'rgb': 'RGB',
    'bgr': 'BGR',
    'rgba': 'RGBA',
    'bgra': 'BGRA',
    'mono': 'GRAY',
    'rggb': 'BayerRGGB',
    'bggr': 'BayerBGGR',
    'gbrg': 'BayerGBRG',
    'grbg': 'BayerGRBG',
}


class CvBridgeError(TypeError):
    """An image cannot be converted; the message says why, and what to do."""


def opencv(what: str) -> Any:
    """
    Import OpenCV.

    Parameters
    ----------
    what
        What it does here, as a part of a sentence.

    Returns
    -------
    module
        cv2.

    Raises
    ------
    ImportError
        It is not installed; the message says how to install it.

    """
    try:
        import cv2
    except ImportError as error:
        raise ImportError(
            f'OpenCV {what}, and it is not installed: run `make setup` in the workspace ({error})',
            name='cv2',
        ) from None
    return cv2


def encoding_of(name: str) -> Encoding:
    """
    Parse the name of an encoding.

    Parameters
    ----------
    name
        Such as 'bgr8'.

    Raises
    ------
    CvBridgeError
        The encoding is unknown.

    """
    try:
        return parse_encoding(name)
    except ValueError as error:
        raise CvBridgeError(str(error)) from None


def convert(pixels: Pixels, source_name: str, target_name: str) -> Pixels:
    """
    Convert an image from one encoding to another.

    Parameters
    ----------
    pixels
        The image, in the byte order of this machine.
    source_name, target_name
        The encodings.

    Returns
    -------
    Pixels
        The converted image; the same array if there is nothing to do.

    Raises
    ------
    CvBridgeError
        An encoding is unknown, or there is no such conversion.
    ImportError
        The conversion needs OpenCV, which is not installed.

    """
    source, target = encoding_of(source_name), encoding_of(target_name)
    if target.colours and not source.colours:
        raise CvBridgeError(
            f"The numbers of '{source_name}' have no meaning as colours, so they cannot become "
            f"'{target_name}': leave the encoding out, or have the image published as mono8, bgr8 "
            'or similar.'
        )
    if source.colours and target.colours and source.colours != target.colours:
        pixels = _in_other_colours(pixels, source, target, f"'{source_name}' to '{target_name}'")
    elif source.channels != target.channels:
        raise CvBridgeError(
            f"'{source_name}' has {source.channels} channels and '{target_name}' "
            f'{target.channels}: there is no conversion between them.'
        )
    return _in_other_type(pixels, np.dtype(target.kind))


def _in_other_colours(pixels: Pixels, source: Encoding, target: Encoding, what: str) -> Pixels:
    cv2 = opencv('converts colours')
    code = getattr(cv2, _code_name(source.colours, target.colours), None)
    if code is None:
        raise CvBridgeError(f'There is no conversion from {what}.')
    try:
        converted: Pixels = cv2.cvtColor(pixels, code)
    except cv2.error as error:
        size = f'{pixels.shape[1]} x {pixels.shape[0]}'
        raise CvBridgeError(
            f'OpenCV cannot convert an image of {size} pixels from {what}: {error}'
        ) from None
    return converted


def _code_name(source: str, target: str) -> str:
    """Return the name of OpenCV's constant for a conversion of colours, if it has it."""
    if source in _NAMES:
        if target in _NAMES:
            return f'COLOR_{_NAMES[source]}2{_NAMES[target]}'
        return f'COLOR_{_NAMES[source]}2YUV_{target.upper()}'
    return f'COLOR_YUV2{_NAMES.get(target, "YUV")}_{source.upper()}'


def _in_other_type(pixels: Pixels, kind: np.dtype[Any]) -> Pixels:
    """Convert the values to another type: the nearest that it has; white stays white."""
    if pixels.dtype == kind:
        return pixels
    if kind.kind == 'f':
        return pixels.astype(kind)
    scales = {('u1', 'u2'): 65535.0 / 255.0, ('u2', 'u1'): 255.0 / 65535.0}
    scale = scales.get((pixels.dtype.str[1:], kind.str[1:]), 1.0)
    limits = np.iinfo(kind)
    values = np.nan_to_num(np.rint(pixels * np.float64(scale)))
    fitting: Pixels = np.clip(values, limits.min, limits.max).astype(kind)
    return fitting
