# SPDX-License-Identifier: Apache-2.0
"""Check the timer for control loops."""

from __future__ import annotations

from statistics import median

from humanoid_common.steady import SteadyTimer
from humanoid_common.testing.ros import ros_sandbox


def test_rate_and_change_of_rate() -> None:
    """The timer keeps its rate, follows a new one at once, and its time never goes back."""
    times: list[float] = []
    with ros_sandbox() as ros:
        timer = SteadyTimer(ros.observer(), 0.01, times.append)
        timer.set_rate(100.0)
        ros.wait_until(lambda: len(times) > 50, what='50 ticks')
    assert times == sorted(times)
    typical_s = median(later - earlier for earlier, later in zip(times, times[1:]))
    assert 0.009 < typical_s < 0.015
    assert times[0] < 5.0
