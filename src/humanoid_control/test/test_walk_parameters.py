# SPDX-License-Identifier: Apache-2.0
"""Check the numbers of the gait and how they grow."""

from __future__ import annotations

import math

from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.parameters import WalkParameters
import pytest


def test_scale_one_changes_nothing() -> None:
    """The robot of scale 1 has the parameters as they are written."""
    assert WalkParameters().scaled(1.0) == WalkParameters()


@pytest.mark.parametrize('scale', [0.5, 0.65, 1.3])
def test_similar_walks(scale: float) -> None:
    """The length of a step in feet and the Froude number do not depend on the size."""
    one, other = WalkParameters(), WalkParameters().scaled(scale)
    assert other.step_s == pytest.approx(one.step_s * math.sqrt(scale))
    assert other.step_width_m == pytest.approx(one.step_width_m * scale)
    stride = one.forward_limit_m_s * one.step_s / one.step_width_m
    assert other.forward_limit_m_s * other.step_s / other.step_width_m == pytest.approx(stride)
    froude = one.forward_limit_m_s**2 / one.swing_height_m
    assert other.forward_limit_m_s**2 / other.swing_height_m == pytest.approx(froude)
    change = other.velocity_change(other.step_s).forward_m_s / other.forward_limit_m_s
    expected = one.velocity_change(one.step_s).forward_m_s / one.forward_limit_m_s
    assert change == pytest.approx(expected)


@pytest.mark.parametrize('scale', [0.0, -1.0, math.nan, math.inf])
def test_no_size_is_refused(scale: float) -> None:
    """A scale that is no size is refused."""
    with pytest.raises(WalkingError, match='is not a size'):
        WalkParameters().scaled(scale)
