# SPDX-License-Identifier: Apache-2.0
"""PNG images for assistants: the camera image, and the map with the robot in it."""

from __future__ import annotations

import math
import struct
from typing import Any
import zlib

import numpy as np
import numpy.typing as npt

__all__ = ['camera_png', 'map_png', 'png_of']

_MOST_PIXELS = 640
_ROBOT = (220, 30, 30)
_ROBOT_M = 0.3
_UNKNOWN, _FREE, _OCCUPIED = (150, 150, 150), (255, 255, 255), (0, 0, 0)
Pixels = npt.NDArray[np.uint8]


def png_of(pixels: Pixels) -> bytes:
    """
    Encode an image as PNG.

    Parameters
    ----------
    pixels
        (height, width, 3): red, green, blue.

    """
    height, width, _ = pixels.shape
    rows = np.zeros((height, 1 + 3 * width), np.uint8)  # each row starts with filter type 0 (none)
    rows[:, 1:] = pixels.reshape(height, 3 * width)
    header = struct.pack('>IIBBBBB', width, height, 8, 2, 0, 0, 0)
    return b'\x89PNG\r\n\x1a\n' + b''.join(
        struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
        for kind, data in (
            (b'IHDR', header),
            (b'IDAT', zlib.compress(rows.tobytes(), 6)),
            (b'IEND', b''),
        )
    )


def camera_png(color: Pixels) -> bytes:
    """
    Encode a camera image as PNG, downsampled to a size that models accept.

    Parameters
    ----------
    color
        (height, width, 3): red, green, blue.

    Returns
    -------
    bytes
        A PNG of at most 640 pixels each way.

    """
    step = math.ceil(max(color.shape[:2]) / _MOST_PIXELS)
    return png_of(np.ascontiguousarray(color[::step, ::step]))


def map_png(
    cells: npt.NDArray[np.int8],
    resolution_m: float,
    origin_m: tuple[float, float],
    robot: tuple[float, float, float] | None,
) -> tuple[bytes, str]:
    """
    Render an occupancy grid as PNG, with y upwards, and describe how to read it.

    Parameters
    ----------
    cells
        (height, width), the lowest row first: -1 unknown, 0 free to 100 occupied.
    resolution_m, origin_m
        The cell size, and the position of the corner of the first cell in the map frame.
    robot
        The pose of the robot: x and y in m, yaw in rad; None if unknown.

    Returns
    -------
    bytes, str
        The PNG, and its legend.

    """
    pixels = np.full((*cells.shape, 3), _FREE, np.uint8)
    pixels[cells < 0] = _UNKNOWN
    pixels[cells >= 50] = _OCCUPIED
    longest = max(cells.shape)
    zoom, step = max(1, _MOST_PIXELS // longest), math.ceil(longest / _MOST_PIXELS)
    pixels = pixels[::step, ::step].repeat(zoom, axis=0).repeat(zoom, axis=1)
    pixel_m = resolution_m * step / zoom
    told = (
        f'A pixel is {100 * pixel_m:.3g} cm; x is to the right, y up; the lower left corner is '
        f'({origin_m[0]:.2f}, {origin_m[1]:.2f}) m. Black is occupied, white free, grey unknown.'
    )
    if robot is None:
        return png_of(pixels[::-1]), f'{told} The position of the robot is unknown.'
    _draw_robot(pixels, pixel_m, origin_m, robot)
    x, y, yaw = robot
    return png_of(pixels[::-1]), (
        f'{told} The robot is the red dot at ({x:.2f}, {y:.2f}) m; its line points forwards, '
        f'{math.degrees(yaw):.0f} degrees from x to y.'
    )


def _draw_robot(
    pixels: Pixels,
    pixel_m: float,
    origin_m: tuple[float, float],
    robot: tuple[float, float, float],
) -> None:
    """Draw the robot as a dot with a line that points forwards."""
    height, width, _ = pixels.shape
    columns: Any = origin_m[0] + (np.arange(width) + 0.5) * pixel_m - robot[0]
    rows: Any = origin_m[1] + (np.arange(height)[:, None] + 0.5) * pixel_m - robot[1]
    ahead = columns * math.cos(robot[2]) + rows * math.sin(robot[2])
    aside = rows * math.cos(robot[2]) - columns * math.sin(robot[2])
    is_line = (np.abs(aside) < max(pixel_m, 0.05)) & (ahead > 0.0) & (ahead < 2.5 * _ROBOT_M)
    pixels[(np.hypot(ahead, aside) < max(_ROBOT_M, 2 * pixel_m)) | is_line] = _ROBOT
