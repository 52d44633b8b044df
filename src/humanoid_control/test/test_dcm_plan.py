# SPDX-License-Identifier: Apache-2.0
"""Check the plan of the divergent component against its equation, integrated."""

from __future__ import annotations

from humanoid_control.walking.dcm_plan import DcmPlan, ZmpSegment
from humanoid_control.walking.errors import WalkingError
import pytest
from scipy.integrate import solve_ivp

RATE_1_S = 3.74
SEGMENTS = [
    ZmpSegment(0.1, 0j, 0.02 + 0.09j),
    ZmpSegment(0.42, 0.02 + 0.09j, 0.02 + 0.09j),
    ZmpSegment(0.1, 0.02 + 0.09j, 0.2 - 0.09j),
    ZmpSegment(0.42, 0.2 - 0.09j, 0.2 - 0.09j),
    ZmpSegment(0.5, 0.2 - 0.09j, 0.2 + 0j),
]
PLAN = DcmPlan(SEGMENTS, RATE_1_S)
TIMES_S = [0.0, 0.05, 0.1, 0.3, 0.55, 0.9, 1.3, 1.54]


@pytest.mark.parametrize('time_s', TIMES_S)
def test_plan_is_the_solution_backwards(time_s: float) -> None:
    """The reference is what the equation xi' = w (xi - p) gives, integrated from the end."""

    def slope(now_s: float, state: list[complex]) -> list[complex]:
        return [RATE_1_S * (state[0] - PLAN.at(now_s).zmp_m)]

    way = (PLAN.duration_s, time_s)
    end = [SEGMENTS[-1].end_m]
    expected = solve_ivp(slope, way, end, rtol=1e-9, atol=1e-11, max_step=0.01).y[0, -1]
    assert PLAN.at(time_s).dcm_m == pytest.approx(expected, abs=2e-6)


def test_plan_is_continuous() -> None:
    """Where one segment ends and the next begins, nothing jumps."""
    for time_s in (0.1, 0.52, 0.62, 1.04, 1.54):
        before, after = PLAN.at(time_s - 1e-9), PLAN.at(time_s + 1e-9)
        assert before.dcm_m == pytest.approx(after.dcm_m, abs=1e-7)
        assert before.zmp_m == pytest.approx(after.zmp_m, abs=1e-7)


def test_plan_rests_at_its_end() -> None:
    """After the plan, weight and divergent component are in the same place for ever."""
    for time_s in (PLAN.duration_s, 99.0):
        end = PLAN.at(time_s)
        assert end.dcm_m == end.zmp_m == SEGMENTS[-1].end_m


def test_before_the_plan_it_stands_still() -> None:
    """A time before the start is the start."""
    assert PLAN.at(-1.0) == PLAN.at(0.0)


def test_empty_plan_is_refused() -> None:
    """There is no plan without segments."""
    with pytest.raises(WalkingError, match='at least one segment'):
        DcmPlan([], RATE_1_S)
