# SPDX-License-Identifier: Apache-2.0
"""Check when pictures are due."""

from __future__ import annotations

from humanoid_simulation.camera.topics import Shutter
import pytest


def taken_ms(rate_hz: float, tick_ms: int, until_ms: int) -> list[int]:
    """Return when pictures are taken, with a tick in so many milliseconds."""
    shutter, times = Shutter(rate_hz), []
    for time_ms in range(0, until_ms, tick_ms):
        if shutter.is_due(time_ms * 1_000_000):
            shutter.release(time_ms * 1_000_000)
            times.append(time_ms)
    return times


def test_on_the_grid() -> None:
    """Pictures are taken where the periods begin."""
    assert taken_ms(10.0, 10, 350) == [0, 100, 200, 300]


@pytest.mark.parametrize('rate_hz', [30.0, 33.3, 7.0])
def test_mean_rate(rate_hz: float) -> None:
    """The mean rate holds when a period is no whole number of ticks."""
    assert len(taken_ms(rate_hz, 10, 10_000)) == pytest.approx(10.0 * rate_hz, abs=1)


def test_late() -> None:
    """What could not be taken in time is due until it is, and then on the grid again."""
    shutter = Shutter(10.0)
    shutter.release(0)
    assert shutter.is_due(150_000_000) and shutter.is_due(250_000_000)
    shutter.release(250_000_000)
    assert not shutter.is_due(290_000_000) and shutter.is_due(300_000_000)


def test_off() -> None:
    """At rate 0 nothing is due after the first time."""
    assert taken_ms(0.0, 10, 5_000) == [0]
