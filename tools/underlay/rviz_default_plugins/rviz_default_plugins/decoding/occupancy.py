# SPDX-License-Identifier: Apache-2.0
"""Decoding of `nav_msgs/msg/OccupancyGrid`: cells and colour schemes."""

from __future__ import annotations

from functools import cache
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from rviz_default_plugins.decoding.geometry import FARTHEST

__all__ = ['Cells', 'apply_update', 'binary', 'cells_of', 'png_of', 'thinned']

Cells = NDArray[np.int8]
Palette = NDArray[np.uint8]

ILLEGAL = (0, 255, 0)
UNKNOWN = (112, 137, 134)


def cells_of(message: Any) -> Cells:
    """
    Convert the data of `nav_msgs/msg/OccupancyGrid` to an array.

    Parameters
    ----------
    message
        The message.

    Returns
    -------
    Cells
        A copy of the cells (height, width), the row with the smallest y first.

    Raises
    ------
    ValueError
        The map has no cells, the cell count does not match the size, or the resolution is invalid.

    """
    width, height = message.info.width, message.info.height
    if not width or not height:
        raise ValueError(f'it has no cells: it is {width} wide and {height} high.')
    resolution = message.info.resolution
    if not 0.0 < resolution * max(width, height) <= FARTHEST:
        raise ValueError(f'its cells are {resolution:g} m long.')
    return _rows(message.data, width, height)


def apply_update(cells: Cells, update: Any) -> None:
    """
    Copy the rectangle of a `map_msgs/msg/OccupancyGridUpdate` into a map.

    Parameters
    ----------
    cells
        The cells of the map (height, width), modified in place.
    update
        The message.

    Raises
    ------
    ValueError
        The rectangle is not inside the map, or its cell count does not match its size.

    """
    height, width = cells.shape
    x, y = update.x, update.y
    if x < 0 or y < 0 or x + update.width > width or y + update.height > height:
        raise ValueError(
            f'an update of {update.width} x {update.height} cells at {x}, {y} is not inside the '
            f'map of {width} x {height}.'
        )
    rows, columns = slice(y, y + update.height), slice(x, x + update.width)
    cells[rows, columns] = _rows(update.data, update.width, update.height)


def thinned(cells: Cells, most: int) -> tuple[Cells, int]:
    """
    Downsample a map to the maximum of each block of cells.

    Parameters
    ----------
    cells
        The cells of the map (height, width).
    most
        The maximum number of cells along a side of the result.

    Returns
    -------
    tuple[Cells, int]
        The smaller map, and n where n x n cells became one.

    """
    step = -(-max(cells.shape) // most)
    if step == 1:
        return cells, 1
    height, width = (-(-length // step) * step for length in cells.shape)
    padded = np.full((height, width), -1, dtype=np.int8)
    padded[: cells.shape[0], : cells.shape[1]] = cells
    blocks = padded.reshape(height // step, step, width // step, step)
    return blocks.max(axis=(1, 3)), step  # occupied cells must not vanish


def binary(cells: Cells, threshold: int) -> Cells:
    """
    Reduce a map to free (0) and occupied (100) cells; negative values are kept.

    Parameters
    ----------
    cells
        The cells of the map (height, width).
    threshold
        The minimum value of an occupied cell.

    """
    return np.where(cells < 0, cells, np.where(cells >= threshold, 100, 0)).astype(np.int8)


def png_of(cells: Cells, scheme: str, alpha: float) -> bytes:
    """
    Encode a map as a PNG file, with the row of the smallest y on top, as the scene expects it.

    Parameters
    ----------
    cells
        The cells of the map (height, width).
    scheme
        The colour scheme: `map`, `costmap` or `raw`.
    alpha
        The opacity, from 0 to 1.

    Returns
    -------
    bytes
        The contents of the file, with a palette of 256 colours.

    """
    palette = _palette(scheme)
    height, width = cells.shape
    picture = Image.frombytes('P', (width, height), np.ascontiguousarray(cells).tobytes())
    picture.putpalette(palette[:, :3].tobytes())
    transparency = (palette[:, 3] * alpha).round().astype(np.uint8).tobytes()
    file = BytesIO()
    picture.save(file, 'PNG', compress_level=1, transparency=transparency)
    return file.getvalue()


def _rows(data: Any, width: int, height: int) -> Cells:
    if len(data) != width * height:
        raise ValueError(
            f'it has {len(data)} cells, but is {width} wide and {height} high, which needs '
            f'{width * height}.'
        )
    return np.array(data, dtype=np.int8).reshape(height, width)


@cache
def _palette(scheme: str) -> Palette:
    """Return the colour of each cell value, as an unsigned byte."""
    palette = np.zeros((256, 4), dtype=np.uint8)
    palette[:, 3] = 255
    values = np.arange(256)
    if scheme == 'raw':
        palette[:, :3] = values[:, None]
        return palette
    part = values[:101] * 255 // 100
    if scheme == 'costmap':
        palette[:101, 0], palette[:101, 2] = part, 255 - part
        palette[0] = 0
        palette[99, :3] = (0, 255, 255)
        palette[100, :3] = (255, 0, 255)
    else:
        palette[:101, :3] = (255 - part)[:, None]
    palette[101:128, :3] = ILLEGAL
    palette[128:255, 0] = 255
    palette[128:255, 1] = np.arange(127) * 255 // 126
    palette[255, :3] = UNKNOWN
    return palette
