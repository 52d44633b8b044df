# SPDX-License-Identifier: Apache-2.0
"""Pictures for assistants."""

from __future__ import annotations

import cv2
import numpy as np
from robot_mcp.pictures import camera_png, map_png, png_of


def shown(png: bytes) -> np.ndarray:
    """Return the pixels of a PNG, as another library reads them."""
    return cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_COLOR)[..., ::-1]


def test_png_is_what_others_read() -> None:
    """Pixel by pixel."""
    pixels = np.random.default_rng(1).integers(0, 256, (7, 5, 3), np.uint8)
    assert (shown(png_of(pixels)) == pixels).all()


def test_large_pictures_are_thinned_out() -> None:
    """To what models take."""
    assert shown(camera_png(np.zeros((1080, 1920, 3), np.uint8))).shape == (360, 640, 3)


def test_a_map_has_y_upwards() -> None:
    """Walls, free and unknown cells, with the robot in it."""
    cells = np.zeros((20, 40), np.int8)
    cells[0] = 100  # the lowest row
    cells[-1] = -1
    png, words = map_png(cells, 0.1, (-1.0, 0.0), (1.0, 1.0, 0.0))
    pixels = shown(png)
    assert pixels.shape == (320, 640, 3)
    assert (pixels[-1] == 0).all() and (pixels[0] == 150).all()
    assert tuple(pixels[160, 320]) == (220, 30, 30) and tuple(pixels[100, 100]) == (255,) * 3
    assert 'red dot at (1.00, 1.00) m' in words
    _, words = map_png(cells, 0.1, (-1.0, 0.0), None)
    assert 'is unknown' in words
