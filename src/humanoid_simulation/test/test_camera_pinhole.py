# SPDX-License-Identifier: Apache-2.0
"""Check the geometry of a camera."""

from __future__ import annotations

import math

from humanoid_simulation.camera.pinhole import Pinhole
from humanoid_simulation.errors import SimulationError
import numpy as np
import pytest


def test_field_of_view() -> None:
    """The edges of the picture, half a pixel beyond the outer pixels, are at half the angle."""
    pinhole = Pinhole(width_px=321, height_px=240, fovy_rad=math.radians(60.0))
    edge = pinhole.matrix @ (0.0, math.tan(math.radians(30.0)), 1.0)
    assert edge == pytest.approx((160.0, 239.5, 1.0))


def test_rays_are_the_inverse_of_the_matrix() -> None:
    """The ray of each pixel is projected onto that pixel."""
    pinhole = Pinhole(width_px=5, height_px=4, fovy_rad=1.0)
    seen = pinhole.rays() @ pinhole.matrix.T
    x_px, y_px = np.meshgrid(np.arange(5), np.arange(4))
    assert np.allclose(seen[..., 0], x_px) and np.allclose(seen[..., 1], y_px)


@pytest.mark.parametrize(
    ('width_px', 'fovy_rad', 'reason'),
    [
        (0, 1.0, '0 x 240 pixels'),
        (320, 0.0, 'field of view'),
        (320, math.pi, 'field of view'),
        (320, math.nan, 'field of view'),
    ],
)
def test_refused(width_px: int, fovy_rad: float, reason: str) -> None:
    """A camera that sees nothing is refused with the reason."""
    with pytest.raises(SimulationError, match=reason):
        Pinhole(width_px, 240, fovy_rad)
