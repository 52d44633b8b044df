# SPDX-License-Identifier: Apache-2.0
"""Check the numbers of the gait and how they grow."""

from __future__ import annotations

import math

from humanoid_common.parameters import build, ParameterError
from humanoid_control.hosting.parameters import HostParameters
from humanoid_control.walking.commands import largest_change
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
    assert other.timing.step_s == pytest.approx(one.timing.step_s * math.sqrt(scale))
    assert other.footsteps.width_m == pytest.approx(one.footsteps.width_m * scale)
    stride = one.velocity.forward_limit_m_s * one.timing.step_s / one.footsteps.width_m
    assert (
        other.velocity.forward_limit_m_s * other.timing.step_s / other.footsteps.width_m
        == pytest.approx(stride)
    )
    froude = one.velocity.forward_limit_m_s**2 / one.swing.height_m
    assert other.velocity.forward_limit_m_s**2 / other.swing.height_m == pytest.approx(froude)
    change, expected = (
        largest_change(each.velocity, each.timing.step_s).forward_m_s
        / each.velocity.forward_limit_m_s
        for each in (other, one)
    )
    assert change == pytest.approx(expected)


def test_they_are_parameters_of_nodes() -> None:
    """By their groups, with the limits within which they can be tuned."""
    settings = build(HostParameters, {'walk.swing.height_m': 0.08, 'walk.posture.arm_swing': 0})
    assert settings.walk.swing.height_m == 0.08
    assert settings.walk.scaled(0.5).swing.height_m == pytest.approx(0.04)
    assert settings.walk.posture.arm_swing == 0.0
    assert settings.walk.timing == WalkParameters().timing
    with pytest.raises(ParameterError, match=r'walk.timing.swing_s.* between 0.09 and 1.44'):
        build(HostParameters, {'walk.timing.swing_s': 0.0})


@pytest.mark.parametrize('rates', [(1.3, 1.6), (1.0, 2.0, 1.5), (1.0, 1.0)])
def test_rates_of_a_hurried_step_grow(rates: tuple[float, ...]) -> None:
    """From that of one that is not hurried; else none would be found for a step."""
    with pytest.raises(ParameterError, match='must start with 1.0 and increase') as refused:
        build(HostParameters, {'walk.step_adjustment.hurry_rates': rates})
    assert refused.value.names == ('walk.step_adjustment.hurry_rates',)
    assert "'walk.step_adjustment.hurry_rates'" in refused.value.reason


@pytest.mark.parametrize('scale', [0.0, -1.0, math.nan, math.inf])
def test_no_size_is_refused(scale: float) -> None:
    """A scale that is no size is refused."""
    with pytest.raises(WalkingError, match='is not a size'):
        WalkParameters().scaled(scale)
