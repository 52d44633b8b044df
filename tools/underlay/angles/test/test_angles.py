# SPDX-License-Identifier: Apache-2.0
"""Differences of angles."""

from __future__ import annotations

import math

import angles
import pytest

PI = math.pi


@pytest.mark.parametrize(
    ('angle', 'centred', 'positive'),
    [
        (0.0, 0.0, 0.0),
        (PI, PI, PI),
        (-PI, PI, PI),
        (2.0 * PI, 0.0, 0.0),
        (-0.5, -0.5, 2.0 * PI - 0.5),
        (5.0 * PI + 0.25, 0.25 - PI, PI + 0.25),
        (-1e-20, 0.0, 0.0),
    ],
)
def test_angles_are_normalized(angle: float, centred: float, positive: float) -> None:
    """Whole turns are taken off, and half a turn is positive."""
    assert angles.normalize_angle(angle) == pytest.approx(centred)
    assert angles.normalize_angle_positive(angle) == pytest.approx(positive)
    assert 0.0 <= angles.normalize_angle_positive(angle) < 2.0 * PI


def test_shortest_turns() -> None:
    """A turn goes through pi if that is shorter; its complement goes the other way."""
    assert angles.shortest_angular_distance(3.0, -3.0) == pytest.approx(2.0 * PI - 6.0)
    assert angles.shortest_angular_distance(0.0, -PI / 2.0) == pytest.approx(-PI / 2.0)
    assert angles.two_pi_complement(PI / 4.0) == pytest.approx(-7.0 * PI / 4.0)
    assert angles.two_pi_complement(-PI / 4.0) == pytest.approx(7.0 * PI / 4.0)
    assert angles.to_degrees(PI) == 180.0
    assert angles.from_degrees(-90.0) == -PI / 2.0


@pytest.mark.parametrize(
    ('start', 'end', 'left', 'right', 'expected'),
    [
        (-0.5, 0.5, 0.25, -0.25, (True, 1.0 - 2.0 * PI)),
        (0.5, -0.5, 0.25, -0.25, (True, 2.0 * PI - 1.0)),
        (-0.5, 0.5, -0.25, 0.25, (False, 1.0)),
        (-0.2, 0.2, -0.25, 0.25, (True, 0.4)),
        (0.2, 0.6, -0.25, 0.25, (False, 0.4)),
        (3.0, -3.0, -3.1, 3.1, (True, -6.0)),
        (-PI, PI, -PI, PI, (True, 2.0 * PI)),
        (PI / 2.0, -PI / 2.0, -PI, PI, (True, -PI)),
    ],
)
def test_turns_within_limits(
    start: float, end: float, left: float, right: float, expected: tuple[bool, float]
) -> None:
    """A turn does not leave the limits; outside of them there is only the shortest one."""
    found = angles.shortest_angular_distance_with_limits(start, end, left, right)
    assert found[0] == expected[0]
    assert found[1] == pytest.approx(expected[1])


@pytest.mark.parametrize(
    ('start', 'end', 'left', 'right', 'expected'),
    [
        (0.0, 10.5 * PI, -2.0 * PI, 2.0 * PI, (True, 0.5 * PI)),
        (10.5 * PI, 0.0, -2.0 * PI, 2.0 * PI, (False, -0.5 * PI)),
        (0.0, 10.5 * PI, -2.0 * PI, 0.1 * PI, (True, -1.5 * PI)),
        (0.0, 1.0, 2.0, -2.0, (False, 1.0)),
        (0.0, 1.0, -0.5, 0.5, (False, 1.0)),
    ],
)
def test_turns_within_large_limits(
    start: float, end: float, left: float, right: float, expected: tuple[bool, float]
) -> None:
    """Limits may be more than a turn apart; the other direction is taken if one is barred."""
    found = angles.shortest_angular_distance_with_large_limits(start, end, left, right)
    assert found[0] == expected[0]
    assert found[1] == pytest.approx(expected[1])


def test_turns_to_the_limits() -> None:
    """A joint within its limits can turn to each of them; one outside has shortest turns."""
    assert angles.find_min_max_delta(0.1, -0.25, 0.5) == pytest.approx((True, -0.35, 0.4))
    turns = angles.find_min_max_delta(PI, 0.25, -0.25)
    assert turns == pytest.approx((True, 0.25 - PI, PI - 0.25))
    assert angles.find_min_max_delta(1.0, -0.25, 0.5) == pytest.approx((False, -1.25, -0.5))
