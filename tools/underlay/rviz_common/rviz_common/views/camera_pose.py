# SPDX-License-Identifier: Apache-2.0
"""From where the page looks at what."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ['CameraPose', 'Point']

Point = tuple[float, float, float]


class CameraPose(NamedTuple):
    """From where the page looks at what, in metres; the field of view is an angle in radians."""

    position: Point
    look_at: Point
    up: Point = (0.0, 0.0, 1.0)
    fov: float = 0.785
    near: float = 0.01
    far: float = 1000.0
