# SPDX-License-Identifier: Apache-2.0
"""Check the series of pushes against robots that stand so much and no more."""

from __future__ import annotations

from humanoid_simulation.examples.push_series import (
    DIRECTIONS,
    NeverStoodError,
    NextAction,
    Push,
    PushPlan,
    PushSeries,
)
import pytest

PLAN = PushPlan(first_ns=5.0, step_ns=5.0, most_ns=20.0)
PERIOD_S = 0.02


class FakeRobot:
    """Falls a second after a push that is too hard, and stands again after a reset."""

    def __init__(self, stands_ns: dict[str, float]) -> None:
        self.pushes: list[Push] = []
        self.resets = 0
        self._stands_ns = stands_ns
        self._falls_at_s = float('inf')

    def run(self, series: PushSeries) -> None:
        """Do what the series says until it is done."""
        for tick in range(1_000_000):
            step = series.update(tick * PERIOD_S, tick * PERIOD_S < self._falls_at_s)
            if step is NextAction.DONE:
                return
            if step is NextAction.PUSH:
                self._take(series.push, tick * PERIOD_S)
            if step is NextAction.RESET:
                self._falls_at_s = float('inf')
                self.resets += 1
        raise AssertionError('the series does not end')

    def _take(self, push: Push, time_s: float) -> None:
        self.pushes.append(push)
        if push.impulse_ns > self._stands_ns[push.direction]:
            self._falls_at_s = time_s + 1.0


def test_the_limit_of_each_direction_is_found() -> None:
    """The hardest push that was stood is kept, at most the hardest that is tried."""
    robot = FakeRobot({'forward': 12.0, 'back': 3.0, 'left': 5.0, 'right': 99.0})
    series = PushSeries(PLAN)
    robot.run(series)
    assert series.stood_ns == {'forward': 10.0, 'back': 0.0, 'left': 5.0, 'right': 20.0}


def test_pushes_grow_and_each_is_followed_by_a_reset() -> None:
    """A direction ends with the first fall."""
    robot = FakeRobot(dict.fromkeys(DIRECTIONS, 7.0))
    robot.run(PushSeries(PLAN))
    assert robot.pushes[:3] == [Push('forward', 5.0), Push('forward', 10.0), Push('back', 5.0)]
    assert robot.resets == len(robot.pushes) == 8


def test_a_robot_has_to_stand_before_it_is_pushed() -> None:
    """The time of settling begins anew whenever it does not stand."""
    series = PushSeries(PLAN)
    times_s = [tick * PERIOD_S for tick in range(300)]
    steps = {time_s: series.update(time_s, stands=time_s > 1.5) for time_s in times_s}
    pushed_s = next(time_s for time_s, step in steps.items() if step is NextAction.PUSH)
    assert pushed_s == pytest.approx(1.5 + PLAN.settle_s, abs=0.05)


def test_a_robot_that_never_stands_is_given_up() -> None:
    """It is not waited for for ever."""
    series = PushSeries(PLAN)
    series.update(0.0, stands=False)
    with pytest.raises(NeverStoodError, match='has not stood still for 2 s within 20 s'):
        series.update(20.5, stands=False)
