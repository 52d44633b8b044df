# SPDX-License-Identifier: Apache-2.0
"""Colours of points, from their channels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rviz_default_plugins.decoding.clouds import Cloud

__all__ = ['Colors', 'Scale', 'colors_rgb8', 'colors_rgbf32', 'rainbow']

Colors = NDArray[np.uint8]

# From 0 to 1 in steps of a fifth: magenta, blue, cyan, green, yellow, red.
_STOPS = np.linspace(0.0, 1.0, 6)
_RED = (1.0, 0.0, 0.0, 0.0, 1.0, 1.0)
_GREEN = (0.0, 0.0, 1.0, 1.0, 1.0, 0.0)
_BLUE = (1.0, 1.0, 1.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Scale:
    """Colour map of values between two limits; by default their minimum and maximum."""

    minimum: float | None = None
    maximum: float | None = None
    is_rainbow: bool = True
    is_inverted: bool = False
    colors: tuple[Sequence[int], Sequence[int]] = ((0, 0, 0), (255, 255, 255))

    def paint(self, values: NDArray[Any]) -> Colors:
        """
        Map values to colours.

        Parameters
        ----------
        values
            A number for each of N points; NaN counts as the minimum.

        Returns
        -------
        Colors
            Red, green and blue (N, 3).

        """
        parts = self._parts(np.asarray(values, dtype=np.float64))
        if self.is_rainbow:
            return rainbow(parts if self.is_inverted else 1.0 - parts)
        low, high = (np.asarray(end, dtype=np.float64) for end in self.colors)
        colors: Colors = (low + parts[:, None] * (high - low)).round().astype(np.uint8)
        return colors

    def _parts(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Normalise the values between the limits to the range from 0 to 1."""
        known = values[np.isfinite(values)]
        low = self._limit(self.minimum, known, np.min)
        high = self._limit(self.maximum, known, np.max)
        span = high - low
        if span == 0.0:
            return np.zeros_like(values)
        with np.errstate(invalid='ignore'):
            parts = np.clip((values - low) / span, 0.0, 1.0)
        return np.nan_to_num(parts, nan=0.0)

    @staticmethod
    def _limit(given: float | None, known: NDArray[np.float64], find: Any) -> float:
        if given is not None:
            return given
        return float(find(known)) if known.size else 0.0


def rainbow(parts: NDArray[np.float64]) -> Colors:
    """
    Map numbers to the colours of the rainbow, from magenta at 0 to red at 1.

    Parameters
    ----------
    parts
        N numbers from 0 to 1.

    Returns
    -------
    Colors
        Red, green and blue (N, 3).

    """
    channels = [np.interp(parts, _STOPS, stops) for stops in (_RED, _GREEN, _BLUE)]
    colors: Colors = (np.stack(channels, axis=-1) * 255.0).round().astype(np.uint8)
    return colors


def colors_rgb8(cloud: Cloud) -> Colors | None:
    """
    Unpack the colours of the field `rgb` or `rgba`, which packs them as bytes of a number.

    Parameters
    ----------
    cloud
        A cloud of N points.

    Returns
    -------
    Colors | None
        Red, green and blue (N, 3); None without such a field of 32 bits.

    """
    packed = cloud.channels.get('rgb', cloud.channels.get('rgba'))
    if packed is None or packed.dtype.itemsize != 4:
        return None
    native = np.ascontiguousarray(packed.astype(packed.dtype.newbyteorder('=')))
    whole = native.view(np.uint32)
    return np.stack([whole >> 16 & 255, whole >> 8 & 255, whole & 255], axis=1).astype(np.uint8)


def colors_rgbf32(cloud: Cloud) -> Colors | None:
    """
    Convert the colours of the fields `r`, `g` and `b`, which are numbers from 0 to 1.

    Parameters
    ----------
    cloud
        A cloud of N points.

    Returns
    -------
    Colors | None
        Red, green and blue (N, 3); None if one of the fields is missing.

    """
    if not all(name in cloud.channels for name in 'rgb'):
        return None
    parts = np.stack([cloud.channels[name].astype(np.float64) for name in 'rgb'], axis=1)
    colors: Colors = (np.clip(np.nan_to_num(parts), 0.0, 1.0) * 255.0).round().astype(np.uint8)
    return colors
