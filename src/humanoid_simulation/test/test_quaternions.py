# SPDX-License-Identifier: Apache-2.0
"""Algebra of quaternions."""

from __future__ import annotations

import math

from humanoid_description.rotations import quaternion_from_rpy
from humanoid_simulation.quaternions import heading_rad, inverse, product, rotated
import numpy as np
import pytest


def test_products_turns_and_inverses() -> None:
    """The second factor comes first; an inverse turns back."""
    first, second = quaternion_from_rpy(0.3, -0.2, 0.9), quaternion_from_rpy(-1.0, 0.4, 0.1)
    vector = np.array([1.0, -2.0, 0.5])
    both = rotated(vector, product(first, second))
    assert both == pytest.approx(rotated(rotated(vector, second), first))
    assert rotated(rotated(vector, first), inverse(first)) == pytest.approx(vector)


@pytest.mark.parametrize('pitch_rad', [0.0, 0.4, -0.4, math.pi / 2, -math.pi / 2, 1.3, -1.3])
def test_who_lies_looks_to_where_it_would_stand_up(pitch_rad: float) -> None:
    """The heading is that of the robot before it fell forwards or backwards."""
    assert heading_rad(quaternion_from_rpy(0.0, pitch_rad, 0.8)) == pytest.approx(0.8, abs=1e-6)
