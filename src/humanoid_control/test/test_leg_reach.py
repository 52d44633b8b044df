# SPDX-License-Identifier: Apache-2.0
"""Check how high the pelvis can be."""

from __future__ import annotations

from humanoid_control.dynamics.frames import Frame
from humanoid_control.dynamics.leg_geometry import LegGeometry
from humanoid_control.dynamics.leg_ik import leg_posture
from humanoid_control.walking.leg_reach import reachable_height_m
from humanoid_description.robot import Robot
import numpy as np
import pytest

REACH = 0.97


@pytest.fixture(name='legs', scope='module')
def _legs(robot: Robot) -> list[LegGeometry]:
    """Return both legs."""
    return [LegGeometry.of(robot, side) for side in ('left', 'right')]


def base_at(height_m: float) -> Frame:
    """Return an upright base."""
    return Frame(np.array([0.0, 0.0, height_m]), np.eye(3))


def test_legs_below_the_hips_change_nothing(legs: list[LegGeometry]) -> None:
    """A robot that stands with bent knees keeps its height."""
    soles = [np.array([0.0, 0.09, 0.0]), np.array([0.0, -0.09, 0.0])]
    assert reachable_height_m(base_at(0.68), legs, soles, REACH) == 0.68


@pytest.mark.parametrize('far', [[0.3, -0.1, 0.0], [-0.25, -0.25, 0.02], [0.0, -0.4, 0.0]])
def test_a_far_foot_lowers_the_pelvis(legs: list[LegGeometry], far: list[float]) -> None:
    """The pelvis sinks until the leg that has to reach far is stretched so much, not more."""
    soles = [np.array([0.0, 0.09, 0.0]), np.array(far)]
    height_m = reachable_height_m(base_at(0.72), legs, soles, REACH)
    assert height_m < 0.7
    sole = Frame(soles[1], np.eye(3)).seen_from(base_at(height_m))
    posture = leg_posture(legs[1], sole)
    assert posture.beyond_m == 0.0
    ankle = soles[1] + legs[1].ankle_m - [0.0, 0.0, height_m]
    assert np.linalg.norm(ankle - legs[1].hip_m) == pytest.approx(REACH * legs[1].length_m)


def test_what_no_leg_reaches(legs: list[LegGeometry]) -> None:
    """A foot farther away than a leg is long brings the hip down to the ankle, not to nonsense."""
    soles = [np.array([0.0, 0.09, 0.0]), np.array([2.0, 0.0, 0.0])]
    height_m = reachable_height_m(base_at(0.7), legs, soles, REACH)
    assert height_m == pytest.approx(0.07 + 0.06)
