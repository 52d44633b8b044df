# SPDX-License-Identifier: Apache-2.0
"""Rotations as quaternions."""

from __future__ import annotations

import math

from humanoid_control.dynamics import rotations as matrices
from humanoid_simulation.rotations import (
    from_rpy,
    from_vector,
    heading_rad,
    inverse,
    product,
    rotated,
)
import numpy as np
import pytest

ANGLES = [(0.0, 0.0, 0.0), (0.3, -0.2, 0.9), (-2.0, 1.2, -3.0), (0.0, math.pi / 2, 0.4)]


@pytest.mark.parametrize('angles', ANGLES)
def test_roll_pitch_and_yaw_are_those_of_a_urdf(angles: tuple[float, float, float]) -> None:
    """The quaternion is the rotation that the controllers compute as a matrix."""
    quaternion = from_rpy(*angles)
    assert matrices.from_quaternion(quaternion) == pytest.approx(matrices.from_rpy(*angles))


def test_products_turns_and_inverses() -> None:
    """The second factor comes first; an inverse turns back."""
    first, second = from_rpy(0.3, -0.2, 0.9), from_rpy(-1.0, 0.4, 0.1)
    vector = np.array([1.0, -2.0, 0.5])
    both = rotated(vector, product(first, second))
    assert both == pytest.approx(rotated(rotated(vector, second), first))
    assert rotated(rotated(vector, first), inverse(first)) == pytest.approx(vector)


def test_a_vector_turns_about_itself_by_its_length() -> None:
    """Also when it is zero."""
    assert from_vector(np.array([0.0, 0.0, 0.7])) == pytest.approx(from_rpy(0.0, 0.0, 0.7))
    assert from_vector(np.zeros(3)) == pytest.approx([1.0, 0.0, 0.0, 0.0])


@pytest.mark.parametrize('pitch_rad', [0.0, 0.4, -0.4, math.pi / 2, -math.pi / 2, 1.3, -1.3])
def test_who_lies_looks_to_where_it_would_stand_up(pitch_rad: float) -> None:
    """The heading is that of the robot before it fell forwards or backwards."""
    assert heading_rad(from_rpy(0.0, pitch_rad, 0.8)) == pytest.approx(0.8, abs=1e-6)
