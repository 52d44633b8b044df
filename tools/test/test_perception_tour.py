# SPDX-License-Identifier: Apache-2.0
"""How the tour of the perception judges what is remembered."""

from __future__ import annotations

import math
from pathlib import Path
import sys

import pytest

# At the end: a benchmark may be named as the package that it measures.
sys.path.append(str(Path(__file__).resolve().parents[1] / 'benchmarks'))
from humanoid_simulation.scene import load_scene  # noqa: E402
from perception_tour import Report, Row, Tally  # noqa: E402


def tally() -> Tally:
    """Return what is true of a thing of the apartment."""
    return Tally(load_scene('apartment').objects[0])


def test_a_thing_in_view_for_a_second_is_wanted() -> None:
    """The time counts from the first picture that shows it."""
    one = tally()
    for time_s in (3.0, 3.5, 4.0):
        assert not one.is_wanted
        one.judge(time_s, True)
    assert one.is_wanted and one.longest_view_s == 1.0


def test_glimpses_do_not_add_up() -> None:
    """A thing that goes out of view has to be in view for a second anew."""
    one = tally()
    for time_s, is_in_view in ((0.0, True), (0.9, True), (1.0, False), (1.1, True), (2.0, True)):
        one.judge(time_s, is_in_view)
    assert not one.is_wanted


def test_a_thing_once_wanted_stays_wanted() -> None:
    """The robot has to remember what it sees no longer."""
    one = tally()
    for time_s, is_in_view in ((0.0, True), (1.0, True), (1.1, False), (9.0, False)):
        one.judge(time_s, is_in_view)
    assert one.is_wanted and one.longest_view_s == 1.0


@pytest.mark.parametrize(
    ('errors_m', 'ghosts', 'simulated_s', 'is_enough'),
    [
        ((0.01,) * 9 + (math.inf,), 1, 60.0, True),
        ((0.01,) * 8 + (0.11, math.inf), 0, 60.0, False),
        ((0.01,) * 10, 2, 60.0, False),
        ((), 0, 60.0, False),
    ],
    ids=['as bad as may be', 'too few remembered', 'too many false', 'nothing was to be seen'],
)
def test_what_is_enough(
    errors_m: tuple[float, ...], ghosts: int, simulated_s: float, is_enough: bool
) -> None:
    """Nine of ten have to be remembered within 0.10 m, with one false thing a minute at most."""
    rows = [Row('mug', 'mug', 2.0, error_m) for error_m in errors_m]
    false = {f'can_{index}': 'nowhere' for index in range(ghosts)}
    assert Report(rows, false, simulated_s).is_enough == is_enough


def test_the_table_begins_with_what_was_missed() -> None:
    """It names each thing, its error if there is one, and what is false."""
    rows = [Row('red_mug', 'mug', 2.5, 0.012), Row('sponge', 'box', 1.0, math.inf)]
    lines = Report(rows, {'can_1': '(1.00, 2.00, 0.70)'}, 60.0).table().splitlines()
    assert lines[1].split() == ['sponge', 'box', '1.0', 'no', '-']
    assert lines[2].split() == ['red_mug', 'mug', '2.5', 'yes', '0.012']
    assert lines[3] == 'false: can_1 at (1.00, 2.00, 0.70)'
    assert lines[4].startswith('remembered 1 of 2 (50%)')
