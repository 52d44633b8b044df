# SPDX-License-Identifier: Apache-2.0
"""The pose of the camera."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ['CameraPose', 'Point']

Point = tuple[float, float, float]


class CameraPose(NamedTuple):
    """The position of the camera and its target in metres, and its field of view in radians."""

    position: Point
    look_at: Point
    up: Point = (0.0, 0.0, 1.0)
    fov: float = 0.785
    near: float = 0.01
    far: float = 1000.0
