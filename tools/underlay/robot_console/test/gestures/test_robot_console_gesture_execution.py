# SPDX-License-Identifier: Apache-2.0
"""A gesture in progress bends the body at its times, and ends as a whole."""

from __future__ import annotations

from typing import Any

import pytest
from robot_console.gestures.gesture_execution import GestureExecution
from robot_console.gestures.gesture_file import BodyPose, UPRIGHT
from robot_console.gestures.gesture_plan import GesturePlan
from robot_console.gestures.robot_watch import STOPPED, why_not

BOW = BodyPose(0.4)


class Stage:
    """A robot that notes down how it is bent, and goals that end when they are told."""

    def __init__(self) -> None:
        """Begin at some time."""
        self.time_s = 100.0
        self.bent: list[BodyPose] = []
        self.is_over = self.is_canceled = False
        self.failure = ''

    def cancel(self) -> None:
        """Note down that the goals are canceled."""
        self.is_canceled = True

    def begin(self) -> GestureExecution:
        """Begin a bow of two seconds."""
        goals: Any = self
        plan = GesturePlan((), ((0.0, BOW), (1.0, UPRIGHT)), 2.0)
        return GestureExecution(plan, goals, self.bent.append, lambda: self.time_s)


@pytest.fixture
def stage() -> Stage:
    """Return a robot."""
    return Stage()


def test_to_the_end(stage: Stage) -> None:
    """It is over when all goals have ended, and its time is over."""
    execution = stage.begin()
    execution.update()
    assert stage.bent == [BOW]
    stage.time_s = 101.0
    execution.update()
    assert stage.bent == [BOW, UPRIGHT]
    stage.is_over = True
    assert not execution.is_over
    stage.time_s = 102.0
    assert execution.is_over and not execution.failure and not stage.is_canceled


def test_canceled(stage: Stage) -> None:
    """The body is upright again, and what was to come does not."""
    execution = stage.begin()
    execution.update()
    execution.cancel()
    execution.cancel('too late')
    stage.time_s = 101.5
    execution.update()
    assert stage.bent == [BOW, UPRIGHT] and stage.is_canceled
    assert not execution.is_over
    stage.is_over = True
    assert execution.is_over and not execution.failure


def test_a_goal_fails(stage: Stage) -> None:
    """All of it ends, with the reason."""
    execution = stage.begin()
    stage.failure = 'It hit something.'
    execution.update()
    assert stage.is_canceled and execution.failure == 'It hit something.'
    assert stage.bent == [], 'it was not bent yet'


def test_the_time_is_reset(stage: Stage) -> None:
    """A reset of the simulation ends it, as its time would never come."""
    execution = stage.begin()
    stage.time_s = 3.0
    execution.update()
    assert execution.failure == "The robot's time was reset."


@pytest.mark.parametrize(
    ('walking', 'stopped', 'holds', 'said'),
    [
        ('stand', False, '', ''),
        ('', False, '', ''),
        ('follow', False, '', ''),
        ('walk', False, '', 'The robot is walking. Let it stand first.'),
        ('fallen', False, '', 'The robot has fallen. Stand it up first.'),
        ('fallen', True, 'x', STOPPED),
        ('stand', False, 'the console is lost', 'The robot holds still: the console is lost.'),
    ],
)
def test_why_not(walking: str, stopped: bool, holds: str, said: str) -> None:
    """A robot that walks, has fallen or is stopped makes no gestures."""
    assert why_not(walking, stopped, holds) == said
