# SPDX-License-Identifier: Apache-2.0
"""When a browser draws less."""

from __future__ import annotations

from collections.abc import Iterable

import pytest
from rviz_common.visualizer.quality import COARSE, FULL, Quality, SIMPLE, TOLD, WITHOUT_CARD


def started(choice: int | None = None, reached: int = FULL, has_card: bool = True) -> Quality:
    """Return the quality of a browser that has just started."""
    quality = Quality()
    quality.begin(choice, reached, has_card)
    return quality


def steps(quality: Quality, rates_hz: Iterable[float], period_s: float = 1.0) -> list[int]:
    """Report a rate each period; return the step after each."""
    found = []
    for number, rate_hz in enumerate(rates_hz):
        before = quality.step
        assert quality.report(rate_hz, number * period_s) is (quality.step != before)
        found.append(quality.step)
    return found


def test_a_fast_browser_draws_everything() -> None:
    """Even at a rate just above the limit, for long."""
    quality = started()
    assert steps(quality, [60.0, 8.0] * 50) == [FULL] * 100
    assert quality.sentence == ''


def test_a_slow_one_steps_down_one_by_one() -> None:
    """Each step gets time to help, and says what it is."""
    quality = started()
    assert steps(quality, [3.0] * 5) == [FULL] * 4 + [SIMPLE]
    assert quality.sentence == TOLD[SIMPLE]
    quality = started()
    seen = steps(quality, [3.0] * 20)
    assert seen.index(COARSE) - seen.index(SIMPLE) == 8
    assert quality.sentence == TOLD[COARSE]


def test_a_moment_is_not_slow() -> None:
    """One that is slow for a few seconds, again and again, is not."""
    assert steps(started(), [3.0, 3.0, 3.0, 20.0] * 20) == [FULL] * 80


def test_a_very_slow_one_reports_rarely() -> None:
    """It takes seconds for each frame, and steps down all the same."""
    assert steps(started(), [0.2] * 3, period_s=8.0) == [FULL, SIMPLE, SIMPLE]


def test_it_never_steps_up() -> None:
    """A step that helped would else be undone, and done again."""
    assert steps(started(), [3.0] * 5 + [60.0] * 50)[4:] == [SIMPLE] * 51


def test_a_hidden_page_is_not_slow() -> None:
    """What was before it was hidden does not count."""
    assert steps(started(), [3.0] * 10, period_s=30.0) == [FULL] * 10


def test_a_browser_without_a_graphics_card_starts_lower() -> None:
    """It says why; how far it got before is not forgotten."""
    quality = started(has_card=False)
    assert (quality.step, quality.sentence) == (SIMPLE, WITHOUT_CARD)
    quality = started(reached=COARSE, has_card=False)
    assert (quality.step, quality.sentence) == (COARSE, TOLD[COARSE])
    assert started(reached=SIMPLE).sentence == TOLD[SIMPLE]


@pytest.mark.parametrize('choice', [FULL, SIMPLE, COARSE])
def test_a_chosen_step_stays(choice: int) -> None:
    """However slow it is, and there is nothing to say."""
    quality = started(choice, reached=COARSE, has_card=False)
    assert steps(quality, [1.0] * 30) == [choice] * 30
    assert quality.sentence == ''
