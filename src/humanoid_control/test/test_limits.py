# SPDX-License-Identifier: Apache-2.0
"""Check that targets ask for no more than the joints can do."""

from __future__ import annotations

from humanoid_control.backends import JointTargets
from humanoid_control.testing import LIMITS, targets
import numpy as np
import pytest


def test_within() -> None:
    """Targets that the joints can reach stay as they are."""
    asked = targets(0.05, -0.05, 0.0, velocity_rad_s=3.0)
    limited = LIMITS.limited(asked, np.zeros(3), 0.01)
    assert limited.positions_rad.tolist() == [0.05, -0.05, 0.0]
    assert limited.velocities_rad_s.tolist() == [3.0] * 3


def test_rate() -> None:
    """A target comes no faster than the joint turns, however long the last period was."""
    asked = targets(0.9, -1.9, 0.0)
    assert LIMITS.limited(asked, np.zeros(3), 0.01).positions_rad.tolist() == [0.1, -0.1, 0.0]
    late = LIMITS.limited(asked, np.zeros(3), 0.05).positions_rad
    assert late.tolist() == pytest.approx([0.5, -0.5, 0.0])


def test_all_limits() -> None:
    """Range, speed and strength are kept."""
    asked = JointTargets(*np.array([[9.0, -9.0, 0.0], [99.0, -99.0, 0.0], [99.0, -99.0, 1.0]]))
    limited = LIMITS.limited(asked, np.zeros(3), 10.0)
    assert limited.positions_rad.tolist() == [1.0, -2.0, 0.0]
    assert limited.velocities_rad_s.tolist() == [10.0, -10.0, 0.0]
    assert limited.efforts_nm.tolist() == [20.0, -20.0, 1.0]
