# SPDX-License-Identifier: Apache-2.0
"""What the panels of safety and driving know, as values."""

from __future__ import annotations

import math
import time
from types import SimpleNamespace
from typing import Any

import pytest
from robot_console.control import Control, People
from robot_console.namespaces import below, NAMESPACE
from robot_console.panels.drive import SpeedLimits
from robot_console.panels.safety import (
    AUTO,
    REAL,
    RealTimeFactor,
    robot_kind,
    SIMULATED,
    STALE_S,
    UNKNOWN,
)
from robot_console.robot_link import EmergencyStop
from std_msgs.msg import Float64

LIMITS = SpeedLimits(0.5, 0.3, 2.0)


@pytest.mark.parametrize(
    ('told', 'clocks', 'kind'),
    [
        (AUTO, 0, UNKNOWN),
        (AUTO, 1, SIMULATED),
        (REAL, 0, REAL),
        (REAL, 1, REAL),
        (SIMULATED, 0, SIMULATED),
    ],
)
def test_kind(told: str, clocks: int, kind: str) -> None:
    """Without being told no robot is called real."""
    assert robot_kind(told, clocks) == kind


@pytest.mark.parametrize(
    ('namespace', 'topic', 'full'),
    [
        ('', 'cmd_vel', 'cmd_vel'),
        ('robot1', 'cmd_vel', '/robot1/cmd_vel'),
        ('fleet/robot1', 'cmd_vel', '/fleet/robot1/cmd_vel'),
        ('robot1', '/clock', '/clock'),
    ],
)
def test_below(namespace: str, topic: str, full: str) -> None:
    """The namespace is put before relative names."""
    assert below(namespace, topic) == full


def test_namespace() -> None:
    """What cannot be a namespace is refused; slashes around do not matter."""
    assert NAMESPACE.read('/robot1/') == 'robot1'
    assert NAMESPACE.read(None) == ''
    for wrong in ('robot 1', '"><script>', '1st', 'a//b'):
        with pytest.raises(ValueError, match="must be like 'robot1'"):
            NAMESPACE.read(wrong)


def test_people() -> None:
    """All connections of a page have one name, which no later page gets."""
    people = People()
    assert people.arrive('a', 'here') == people.arrive('a', 'here') == 'browser 1 (here)'
    assert people.arrive('b', 'there') == 'browser 2 (there)'
    people.leave('a')
    assert people.arrive('a', 'here') == 'browser 1 (here)'
    people.leave('a')
    people.leave('a')
    assert people.arrive('a', 'here') == 'browser 3 (here)'


def test_stop_that_others_publish() -> None:
    """Who pressed is remembered until somebody else says otherwise."""
    stop = EmergencyStop()
    stop.hear(False)
    assert (stop.pressed, stop.heard) == (False, True)
    stop.say(True, 'ann')
    stop.hear(True)
    assert stop == EmergencyStop(True, 'ann', True)
    stop.hear(False)
    assert stop == EmergencyStop(False, '', True)


def test_velocity() -> None:
    """The stick has its share of the limits, and never more than these."""
    assert LIMITS.velocity([1, 0, -0.5], [0.5, 1]) == (0.25, 0.0, -1.0)
    assert LIMITS.velocity([9.0, -9.0, 9.0], [7.0, 7.0]) == (0.5, -0.3, 2.0)
    assert LIMITS.velocity([1.0, 1.0, 1.0], [-1.0, -1.0]) == (0.0, 0.0, 0.0)
    assert LIMITS.velocity([10**400, 0, 0], [1, 1]) == (0.5, 0.0, 0.0)


@pytest.mark.parametrize(
    'stick', [None, 'x', [], [1.0], [math.nan, 0, 0], [math.inf, 0, 0], ['1', 0, 0], [True, 0, 0]]
)
def test_wrong_stick(stick: Any) -> None:
    """What is no stick moves nothing."""
    with pytest.raises(ValueError, match='numbers'):
        LIMITS.velocity(stick, [1.0, 1.0])
    with pytest.raises(ValueError, match='numbers'):
        LIMITS.velocity([0, 0, 0], stick)


def test_number_that_fits_no_float() -> None:
    """A whole number may be as long as it likes; the limit holds."""
    assert LIMITS.velocity([10**400, 0, 0], [1, 1]) == (0.5, 0.0, 0.0)
    assert LIMITS.velocity([-(10**400), 0, 0], [10**400, 1]) == (-0.5, 0.0, 0.0)


def test_one_at_a_time() -> None:
    """A second person gets control only when the first one has given it back."""
    control = Control()
    assert control.take('ann', 1)
    assert not control.take('bob', 2)
    assert control.person == 'ann' and control.holds(1) and not control.holds(2)
    assert control.give(1)
    assert control.take('bob', 2)


def test_several_pages_of_one_person() -> None:
    """A person who has control with two pages has it until both gave it back."""
    control = Control()
    assert control.take('ann', 1) and control.take('ann', 2)
    assert not control.give(1)
    assert control.person == 'ann'
    assert control.give(2)
    assert control.person == '' and control.lost == ''


def test_lost() -> None:
    """Who is lost with one page is not in control any more, and this is known."""
    control = Control()
    control.take('ann', 1)
    control.take('ann', 2)
    assert control.lose(1)
    assert (control.person, control.lost) == ('', 'ann')
    assert not control.holds(2)
    assert control.take('bob', 3)
    assert control.lost == ''


def test_bystanders() -> None:
    """Pages without control have nothing to give back or to lose."""
    control = Control()
    control.take('ann', 1)
    assert not control.give(2) and not control.lose(2)
    assert control.person == 'ann'


@pytest.fixture(name='factor')
def _factor() -> RealTimeFactor:
    node = SimpleNamespace(create_subscription=lambda *arguments: None)
    return RealTimeFactor(node)  # type: ignore[arg-type]


def test_the_newest_factor_counts(factor: RealTimeFactor) -> None:
    """What was said last is true, until nobody says anything for a while."""
    now_s = time.monotonic()
    assert factor.factor(now_s) is None
    factor._hear(Float64(data=0.5))
    factor._hear(Float64(data=0.25))
    assert factor.factor(now_s + 1.0) == 0.25
    assert factor.factor(now_s + 2 * STALE_S) is None


def test_what_is_no_number_is_left_out(factor: RealTimeFactor) -> None:
    """A page could not read it."""
    factor._hear(Float64(data=math.nan))
    assert factor.factor(time.monotonic()) is None
