# SPDX-License-Identifier: Apache-2.0
"""Check poses of the ground plane."""

from __future__ import annotations

import math

from humanoid_control.walking.planar import cross, dot, limited, PlanarPose
import pytest

POSE = PlanarPose(2 + 1j, math.pi / 2)


def test_ahead_and_left() -> None:
    """Ahead of a pose that faces along y is y, to its left is -x."""
    assert POSE.at(3.0, 1.0) == pytest.approx(1 + 4j)


def test_local_undoes_at() -> None:
    """A point seen from a pose is where it was put."""
    assert POSE.local(POSE.at(0.3, -0.7)) == pytest.approx(0.3 - 0.7j)


def test_halfway_turns_the_short_way() -> None:
    """Between 170 and -170 degrees lies 180, not 0."""
    middle = PlanarPose(0j, math.radians(170)).halfway(PlanarPose(2j, math.radians(-170)))
    assert middle.position_m == 1j
    assert abs(middle.yaw_rad) == pytest.approx(math.pi)


def test_products() -> None:
    """Scalar and cross product are those of vectors."""
    assert dot(1 + 2j, 3 + 4j) == 11
    assert cross(1 + 2j, 3 + 4j) == -2


def test_limits() -> None:
    """A value outside limits becomes the limit."""
    assert [limited(value, -1.0, 2.0) for value in (-5.0, 0.5, 5.0)] == [-1.0, 0.5, 2.0]
