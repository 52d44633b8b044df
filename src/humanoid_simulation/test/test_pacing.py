# SPDX-License-Identifier: Apache-2.0
"""How fast the time of the world passes."""

from __future__ import annotations

from humanoid_simulation.errors import SimulationError
from humanoid_simulation.pacing import MOST_LATE_S, Pacer
import pytest


def simulate(pacer: Pacer, seconds: float, cost_s: float, now_s: float = 0.0) -> tuple[int, float]:
    """Run for so long on a clock of our own; a period costs so much. Return how many ran."""
    end_s, periods = now_s + seconds, 0
    while now_s < end_s:
        wait_s = pacer.wait_s(now_s)
        if wait_s > 0.0:
            now_s += wait_s
            continue
        now_s += cost_s
        pacer.ticked(now_s)
        periods += 1
    return periods, now_s


@pytest.mark.parametrize('factor', [0.25, 1.0, 5.0])
def test_periods_follow_at_the_factor(factor: float) -> None:
    """In ten seconds there are as many as the factor says, and that is what is reported."""
    pacer = Pacer(0.01, factor, 0.0)
    periods, _ = simulate(pacer, 10.0, 0.001)
    assert periods == pytest.approx(1000 * factor, rel=0.01)
    assert pacer.reached == pytest.approx(factor, rel=0.02)


def test_as_fast_as_possible() -> None:
    """A factor of zero never waits."""
    pacer = Pacer(0.01, 0.0, 0.0)
    periods, _ = simulate(pacer, 2.0, 0.001)
    assert periods == pytest.approx(2000, rel=0.01)
    assert pacer.reached == pytest.approx(10.0, rel=0.02)


def test_a_computer_that_is_too_slow_says_so() -> None:
    """The factor that is reached is that of the computer."""
    pacer = Pacer(0.01, 1.0, 0.0)
    simulate(pacer, 3.0, 0.02)
    assert pacer.reached == pytest.approx(0.5, rel=0.02)


def test_a_short_delay_is_caught_up_with_and_a_long_one_is_not() -> None:
    """After a standstill of a minute the world does not race through that minute."""
    pacer = Pacer(0.01, 1.0, 0.0)
    _, now_s = simulate(pacer, 1.0, 0.0001)
    periods, now_s = simulate(pacer, 1.0, 0.0001, now_s + 0.05)
    assert periods == pytest.approx(105, abs=2)
    periods, _ = simulate(pacer, 1.0, 0.0001, now_s + 60.0)
    assert periods == pytest.approx(100 + MOST_LATE_S / 0.01, abs=2)


def test_a_pause_is_not_caught_up_with() -> None:
    """After a restart the next period is due at once, and then one after the other."""
    pacer = Pacer(0.01, 1.0, 0.0)
    pacer.restart(10.0)
    assert pacer.wait_s(10.0) == 0.0
    pacer.ticked(10.0)
    assert pacer.wait_s(10.0) == pytest.approx(0.01)
    assert pacer.reached is None


def test_the_factor_can_be_changed() -> None:
    """From then on periods follow at the new one."""
    pacer = Pacer(0.01, 1.0, 0.0)
    pacer.change(2.0, 5.0)
    pacer.ticked(5.0)
    assert pacer.wait_s(5.0) == pytest.approx(0.005)
    assert pacer.factor == 2.0


@pytest.mark.parametrize('factor', [-1.0, float('nan'), 1e6])
def test_factors_that_make_no_sense(factor: float) -> None:
    """The error says what one can give."""
    with pytest.raises(SimulationError, match='Give 1 for real time'):
        Pacer(0.01, factor, 0.0)
