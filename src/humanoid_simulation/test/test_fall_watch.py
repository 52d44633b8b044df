# SPDX-License-Identifier: Apache-2.0
"""Check what counts as a fall."""

from __future__ import annotations

import math

from humanoid_simulation.examples.fall_watch import FallWatch, tilt_rad
import pytest


def test_low_or_steep_is_fallen() -> None:
    """What was seen first is the height of a robot that stands, whatever its size."""
    watch = FallWatch()
    assert watch.stands(0.7, 0.0)
    assert watch.stands(0.5, 0.5)
    assert not watch.stands(0.3, 0.0)
    assert not watch.stands(0.7, 1.0)


@pytest.mark.parametrize('yaw', [0.0, 1.0, 3.0])
@pytest.mark.parametrize('pitch', [0.0, 0.4, 2.0])
def test_tilt_is_the_angle_to_the_vertical(yaw: float, pitch: float) -> None:
    """Turning about the vertical does not tilt, and the length of the quaternion is no matter."""
    cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
    cp, sp = math.cos(pitch / 2), math.sin(pitch / 2)
    x, y, z, w = -sy * sp, cy * sp, sy * cp, cy * cp
    assert tilt_rad(2 * x, 2 * y, 2 * z, 2 * w) == pytest.approx(pitch, abs=1e-7)


def test_what_is_no_rotation_is_fallen() -> None:
    """Zeros and NaN say nothing, and are not taken for standing."""
    assert tilt_rad(0.0, 0.0, 0.0, 0.0) == math.inf
    assert tilt_rad(math.nan, 0.0, 0.0, 1.0) == math.inf
