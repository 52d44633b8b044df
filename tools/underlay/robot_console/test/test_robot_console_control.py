# SPDX-License-Identifier: Apache-2.0
"""Take control of a robot, give it back, and lose it."""

from __future__ import annotations

from robot_console.control import Control


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
