# SPDX-License-Identifier: Apache-2.0
"""Convert the pixels of a map's image to cell occupancies and back."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

__all__ = ['MODES', 'OccupancyMap', 'Thresholds', 'occupancies_of', 'pixels_of']

MODES = ('trinary', 'scale', 'raw')
"""Interpretation of pixels: as free, occupied or unknown; as percentages; or as raw values."""

UNKNOWN = -1
OCCUPIED = 100
_UNKNOWN_PIXEL = 205
_FREE_PIXEL = 254

PixelArray = npt.NDArray[np.uint8]
OccupancyArray = npt.NDArray[np.int8]


@dataclass(frozen=True)
class OccupancyMap:
    """Occupancy grid map."""

    occupancies: OccupancyArray
    """(rows, columns) percentages; -1 is unknown. The first row has the lowest y."""
    resolution_m: float
    """The side length of a cell."""
    origin: tuple[float, float, float]
    """The pose of the outer corner of the first cell: x and y in m, yaw in rad."""


@dataclass(frozen=True)
class Thresholds:
    """Thresholds of the occupancy probability for free and occupied cells."""

    free: float = 0.25
    occupied: float = 0.65

    def __post_init__(self) -> None:
        if not 0.0 <= self.free < self.occupied <= 1.0:
            raise ValueError(
                f'The threshold of free cells ({self.free:g}) must be less than that of '
                f'occupied ones ({self.occupied:g}), and both from 0 to 1'
            )


def occupancies_of(
    pixels: PixelArray,
    mode: str,
    thresholds: Thresholds,
    *,
    negate: bool = False,
    opacity: PixelArray | None = None,
) -> OccupancyArray:
    """
    Convert the pixels of an image to occupancies.

    Parameters
    ----------
    pixels
        (rows, columns) brightness from 0 to 255, the top row first.
    mode
        'trinary', 'scale' or 'raw'.
    thresholds
        The thresholds beyond which a pixel is occupied if dark, or free if bright.
    negate
        Whether bright pixels are occupied; ignored in raw mode.
    opacity
        The alpha channel. Pixels that are not opaque are unknown in mode 'scale', and transparent
        ones in mode 'trinary'.

    Returns
    -------
    (rows, columns) occupancies, the bottom row first.

    """
    if mode == 'raw':
        raw = np.where(pixels <= OCCUPIED, pixels, 255).astype(np.uint8).view(np.int8)
        return np.ascontiguousarray(raw[::-1])
    shades = np.arange(256) / 255.0
    probabilities = shades if negate else 1.0 - shades
    if mode == 'scale':
        span = thresholds.occupied - thresholds.free
        table = np.rint((probabilities - thresholds.free) / span * 100.0).clip(0, 100)
    else:
        table = np.full(256, UNKNOWN)
    table[probabilities > thresholds.occupied] = OCCUPIED
    table[probabilities < thresholds.free] = 0
    found = table.astype(np.int8)[pixels]
    if opacity is not None:
        found[opacity < (255 if mode == 'scale' else 1)] = UNKNOWN
    return np.ascontiguousarray(found[::-1])


def pixels_of(
    occupancies: OccupancyArray, mode: str, thresholds: Thresholds
) -> tuple[PixelArray, PixelArray | None]:
    """
    Convert occupancies to the pixels of an image, the inverse of `occupancies_of`.

    Parameters
    ----------
    occupancies
        (rows, columns) percentages and -1, the bottom row first.
    mode, thresholds
        As for `occupancies_of`; percentages up to and from the thresholds are free and occupied.

    Returns
    -------
    (rows, columns) brightness, the top row first, and the alpha channel in mode 'scale'.

    """
    cells = occupancies[::-1].astype(int)
    unknown = (cells < 0) | (cells > OCCUPIED)
    if mode == 'raw':
        return np.where(unknown, 255, cells).astype(np.uint8), None
    if mode == 'scale':
        span = thresholds.occupied - thresholds.free
        probabilities = thresholds.free + cells / 100.0 * span
        shades = np.rint((1.0 - probabilities) * 255.0)
        pixels = np.where(unknown, _UNKNOWN_PIXEL, shades).astype(np.uint8)
        return pixels, np.where(unknown, 0, 255).astype(np.uint8)
    pixels = np.full(cells.shape, _UNKNOWN_PIXEL, np.uint8)
    pixels[cells <= round(thresholds.free * 100.0)] = _FREE_PIXEL
    pixels[cells >= round(thresholds.occupied * 100.0)] = 0
    pixels[unknown] = _UNKNOWN_PIXEL
    return pixels, None
