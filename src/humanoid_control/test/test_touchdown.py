# SPDX-License-Identifier: Apache-2.0
"""Check when a swing foot counts as on the ground."""

from __future__ import annotations

from humanoid_control.walking.footing import SoleReading
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import LEVEL, PlanarPose
from humanoid_control.walking.swing_foot import StepClock
from humanoid_control.walking.touchdown import Touchdown
import pytest

P = WalkParameters()
TICK_S = 0.01


def sole(load: float, drag: complex = 0j) -> SoleReading:
    """Return a measurement of the swing foot."""
    return SoleReading(PlanarPose(), LEVEL, load, drag)


def clock_at(phase: float) -> StepClock:
    """Return the clock of a step at a phase of its swing."""
    clock = StepClock(P, P.timing.shift_s)
    clock.elapsed_s = P.timing.shift_s + phase * P.timing.swing_s
    return clock


@pytest.mark.parametrize(
    ('phase', 'load', 'drag', 'touches'),
    [
        (0.4, 0.5, 0j, False),
        (0.6, 0.1, 0j, False),
        (0.6, 0.2, 0j, True),
        (0.8, 0.1, 0j, True),
        (0.8, 0.1, 0.2j, False),
        (1.6, 0.0, 0j, True),
    ],
)
def test_touchdown(phase: float, load: float, drag: complex, touches: bool) -> None:
    """Late in the swing less load is enough; friction of an obstacle and early loads do not."""
    touchdown = Touchdown(P.swing)
    assert touchdown.update(sole(load, drag), clock_at(phase), TICK_S) is touches
    assert touchdown.has_touched is touches


def test_the_loss_of_contact_takes_some_time() -> None:
    """A foot that bears nothing for a while has left the ground; a short gap does not count."""
    touchdown, clock = Touchdown(P.swing), clock_at(0.8)
    assert touchdown.update(sole(0.2), clock, TICK_S)
    for load in (0.0, 0.0, 0.1, 0.0, 0.0):
        assert not touchdown.update(sole(load), clock, TICK_S)
        assert touchdown.has_touched
    assert touchdown.update(sole(0.0), clock, TICK_S)
    assert not touchdown.has_touched


def test_the_planned_landing_ends_the_search_for_a_loss() -> None:
    """After the planned landing a foot that has touched stays, whatever it bears."""
    touchdown = Touchdown(P.swing)
    assert touchdown.update(sole(0.2), clock_at(0.9), TICK_S)
    assert not touchdown.update(sole(0.0), clock_at(1.1), 1.0)


@pytest.mark.parametrize(
    ('phase', 'load', 'bears'),
    [(0.8, 0.5, False), (0.9, 0.1, False), (0.9, 0.2, True), (1.1, 0.0, True)],
)
def test_a_foot_that_has_landed_may_bear(phase: float, load: float, bears: bool) -> None:
    """Near the end of the swing a loaded foot may take the weight, and later any that touches."""
    touchdown = Touchdown(P.swing)
    touchdown.has_touched = True
    assert touchdown.may_bear(sole(load), clock_at(phase)) is bears


def test_only_a_landing_that_is_overdue_needs_no_touchdown() -> None:
    """The step ends then."""
    touchdown = Touchdown(P.swing)
    assert not touchdown.may_bear(sole(1.0), clock_at(1.1))
    assert touchdown.may_bear(sole(0.0), clock_at(1.6))
