# SPDX-License-Identifier: Apache-2.0
"""A robot without dynamics walks to places, and says when it cannot."""

from __future__ import annotations

import math

import pytest
from robot_console.panels.drive import SpeedLimits, STILL, Velocity
from robot_console.walk_here.straight_walk import Outcome, Place, StraightWalk, Target

LIMITS = SpeedLimits(0.3, 0.0, 0.6)
PERIOD_S = 0.05
START = Place(1.0, 2.0, 0.5)


def moved(place: Place, velocity: Velocity) -> Place:
    """Return where a robot is after a period."""
    yaw_rad = math.remainder(place.yaw_rad + PERIOD_S * velocity.turn_rad_s, math.tau)
    step_m = PERIOD_S * velocity.forward_m_s
    return Place(
        place.x_m + step_m * math.cos(yaw_rad), place.y_m + step_m * math.sin(yaw_rad), yaw_rad
    )


def walked(
    target: Target, follows: float = 1.0
) -> tuple[StraightWalk, list[Place], list[Velocity]]:
    """Walk to the end, with a robot that follows a part of each command."""
    walk = StraightWalk(target, LIMITS, START, 0.0)
    places, commands = [START], []
    while walk.outcome is None:
        assert len(places) < 10_000, 'it never ends'
        commands.append(walk.update(places[-1], PERIOD_S * len(commands)))
        velocity = Velocity(*(follows * each for each in commands[-1]))
        places.append(moved(places[-1], velocity))
    return walk, places, commands


@pytest.mark.parametrize('bearing_rad', [0.0, 1.5, math.pi, -2.0])
@pytest.mark.parametrize('distance_m', [0.05, 0.3, 3.0])
@pytest.mark.parametrize('yaw_rad', [None, -3.0])
def test_it_arrives(bearing_rad: float, distance_m: float, yaw_rad: float | None) -> None:
    """From any side it turns first, walks straight, and slows down at the end."""
    angle_rad = START.yaw_rad + bearing_rad
    x_m = START.x_m + distance_m * math.cos(angle_rad)
    y_m = START.y_m + distance_m * math.sin(angle_rad)
    walk, places, commands = walked(Target(x_m, y_m, yaw_rad))
    end = places[-1]
    assert walk.outcome is Outcome.ARRIVED
    assert math.hypot(end.x_m - x_m, end.y_m - y_m) < 0.12
    if yaw_rad is not None:
        assert abs(math.remainder(end.yaw_rad - yaw_rad, math.tau)) < 0.12
    assert commands[-1] == STILL
    for command in commands:
        assert 0.0 <= command.forward_m_s <= 0.3 and abs(command.turn_rad_s) <= 0.6
        assert command.left_m_s == 0.0
    walking = [each.forward_m_s for each in commands if each.forward_m_s]
    if distance_m == 3.0:
        assert max(walking) > 0.29 and walking[-1] < 0.15
        ahead = commands.index(next(each for each in commands if each.forward_m_s))
        assert (places[ahead].x_m, places[ahead].y_m) == (START.x_m, START.y_m)
        away_m = max(
            abs(
                (each.x_m - START.x_m) * math.sin(angle_rad)
                - (each.y_m - START.y_m) * math.cos(angle_rad)
            )
            for each in places
        )
        assert away_m < 0.2


def test_it_is_stuck() -> None:
    """A robot that does not move gives up after some seconds."""
    walk, places, _ = walked(Target(3.0, 2.0), 0.0)
    assert walk.outcome is Outcome.STUCK
    assert len(places) * PERIOD_S == pytest.approx(6.0, abs=0.3)


def test_it_takes_too_long() -> None:
    """A robot that hardly follows gives up; a time that is reset ends a walk, too."""
    walk, _, _ = walked(Target(4.0, 3.0), 0.1)
    assert walk.outcome is Outcome.TIMED_OUT
    reset = StraightWalk(Target(4.0, 3.0), LIMITS, START, 100.0)
    assert reset.update(START, 1.0) == STILL and reset.outcome is Outcome.TIMED_OUT
