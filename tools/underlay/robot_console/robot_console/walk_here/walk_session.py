# SPDX-License-Identifier: Apache-2.0
"""A walk to a clicked place, which goes on while the page of the person who clicked lives."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from itertools import count
import time
from typing import Any

from robot_console.control_page import Session
from robot_console.panels.drive import SpeedLimits, STILL, STOPPED, Velocity
from robot_console.robot_link import RobotLink
from robot_console.state_words import WALKING
from robot_console.walk_here.straight_walk import Outcome, Place, StraightWalk, Target

__all__ = ['STALE_S', 'RobotNow', 'WalkGoal', 'WalkSession', 'present_goal']

TAKE_S = 3.0
"""The time in which the page of the person who has clicked has to take the goal."""
STALE_S = 1.0
"""Odometry that is older is missing."""
NOT_TAKEN = 'The click did not come from a page that is open here. Click again.'
NO_ODOMETRY = 'Stopped: the odometry of the robot is missing.'
CANCELED = 'Stopped.'
LOST = 'Stopped: the page of {} was lost, or stalled.'
DRIVEN = 'Ended: somebody drives the robot.'
LEFT = '{left}'
"""What stands for how far it still is in a sentence."""
DOWN = ('fallen', 'stand_up')
OUTCOMES = {
    Outcome.ARRIVED: 'Arrived.',
    Outcome.STUCK: 'Stopped: the robot gets no nearer, {left}. Something may be in its way.',
    Outcome.TIMED_OUT: 'Stopped: it took too long, {left}.',
}

_numbers = count(1)


@dataclass(frozen=True)
class RobotNow:
    """What a walk needs to know of a robot."""

    place: Place
    time_s: float
    """The robot's time of the place."""
    heard_s: float
    """The time of `time.monotonic` at which it was heard."""
    walking: str = ''
    """The walking state; '' if it is not known."""


class WalkGoal:
    """
    A walk to a place: who does it, and how it has ended.

    Parameters
    ----------
    target
        Where to walk.
    end_text
        How it has ended already, for a click that is refused; '' for one that is not.
    browser
        The number of the browser in which somebody has clicked, whose page takes the goal.

    Attributes
    ----------
    number
        Identifies it in the pages.
    text
        How it has ended, as a sentence; '' while it has not.
    walk
        The controller, once a page has taken the goal.
    owner
        The session that has taken it.
    is_refused
        Whether it was, as another person was in control.

    """

    def __init__(self, target: Target, end_text: str = '', browser: int | None = None) -> None:
        self.number = next(_numbers)
        self.target, self.text, self.browser = target, end_text, browser
        self.walk: StraightWalk | None = None
        self.owner: WalkSession | None = None
        self.is_refused = False
        self._asked_s = time.monotonic()

    @property
    def is_waiting(self) -> bool:
        """Whether a page may take it; ends it if none has in time."""
        if self.text or self.owner is not None:
            return False
        if time.monotonic() - self._asked_s > TAKE_S:
            self.text = NOT_TAKEN
        return not self.text

    @property
    def is_open(self) -> bool:
        """Whether it is not over: a page carries it out, or may take it."""
        return self.is_waiting or not self.text


def present_goal(goals: Iterable[WalkGoal]) -> WalkGoal | None:
    """
    Choose the goal that pages show: one that is not over, or else the last one.

    Parameters
    ----------
    goals
        The goals, the newest last.

    """
    found: WalkGoal | None = None
    for goal in goals:
        if not goal.is_refused and (found is None or found.text or not goal.text):
            found = goal
    return found


class WalkSession(Session):
    """
    Walks to a place while a page repeats its request.

    The rules are those of driving: one person is in control, the emergency stop ends the walk, and
    so does a page that is silent.

    Parameters
    ----------
    link
        The link to the robot.
    person
        The user of the page, as shown to others.
    limits
        The speed limits.
    say
        Publishes a velocity command of the base.
    goal
        Returns the goal that waits or is done, or else the last one; None if there was none.
    robot
        Returns what is known of the robot; None if it is not known where it is.

    """

    def __init__(
        self,
        link: RobotLink,
        person: str,
        limits: SpeedLimits,
        say: Callable[[Velocity], None],
        goal: Callable[[], WalkGoal | None],
        robot: Callable[[], RobotNow | None],
    ) -> None:
        super().__init__(link, person)
        self._limits, self._say = limits, say
        self._goal, self._robot = goal, robot
        self._mine: WalkGoal | None = None
        self._refused: WalkGoal | None = None

    @property
    def actions(self) -> Mapping[str, Callable[[Mapping[str, Any]], None]]:
        """Return the actions that the page may request."""
        return {
            'beat': lambda message: self._end(CANCELED),
            'walk': self._walk,
            'cancel': lambda message: self._cancel(),
        }

    @property
    def is_watched(self) -> bool:
        """Whether the watchdog monitors the page."""
        return self._mine is not None or super().is_watched

    def state(self) -> dict[str, Any]:
        """Return the state that the page shows."""
        newest, refused = self._goal(), self._refused
        goal = self._mine or newest
        state = {
            **super().state(),
            'goal': None,
            'waiting': 0,
            'browser': None,
            'refused': refused.number if refused is not None else 0,
            'refusal': refused.text if refused is not None else '',
        }
        if newest is not None and newest.is_waiting:
            state.update(waiting=newest.number, browser=newest.browser)
        if goal is not None:
            state['goal'] = {
                'number': goal.number,
                'text': goal.text,
                'who': goal.owner.person if goal.owner is not None else '',
                'distance': goal.walk.distance_m if goal.walk is not None else None,
            }
        return state

    def lose(self) -> None:
        """Stop the robot, since the page is lost or its watchdog has expired."""
        self._stand_still(LOST.format(self.person))
        super().lose()

    def _walk(self, message: Mapping[str, Any]) -> None:
        """Take a goal, or go on with it."""
        number = message.get('number')
        if self._mine is None or self._mine.number != number:
            self._take(number)
        goal = self._mine
        if goal is None or goal.text:
            self._end(CANCELED)
            return
        now = self._robot()
        if now is None or time.monotonic() - now.heard_s > STALE_S:
            self._end(NO_ODOMETRY)
            return
        if goal.walk is None:
            goal.walk = StraightWalk(goal.target, self._limits, now.place, now.time_s)
        walk, velocity = goal.walk, STILL
        reason = self._why_not(walk, now.walking)
        if not reason:
            velocity = walk.update(now.place, now.time_s)
            reason = OUTCOMES[walk.outcome] if walk.outcome is not None else ''
        if reason:
            self._end(reason.replace(LEFT, f'{walk.distance_m:.1f} m before the place'))
        else:
            self._say(velocity)

    def _take(self, number: Any) -> None:
        """Take the goal with a number, if no other page has."""
        self._end(CANCELED)
        goal = self._goal()
        if goal is None or goal.number != number or not goal.is_waiting:
            return
        person = self.link.control.person
        if person and person != self.person:
            goal.text, goal.is_refused = f'{person} is in control.', True
            self._refused = goal
            return
        self._refused = None
        goal.owner, self._mine, self.link.mover = self, goal, self

    def _why_not(self, walk: StraightWalk, walking: str) -> str:
        """Take control, or return why the walk ends."""
        if self.link.stop.pressed:
            return STOPPED
        if self.link.holds_because:
            return f'The robot holds still: {self.link.holds_because}.'
        # A blocked robot can turn away.
        if walking in DOWN or (walking == 'blocked' and walk.is_ahead):
            return f'{WALKING[walking].reason}, {LEFT}.'
        if not self.link.control.take(self.person, self):
            return f'{self.link.control.person} is in control.'
        return '' if self.link.mover is self else DRIVEN

    def _cancel(self) -> None:
        """End the goal, whoever has taken it."""
        goal = self._goal()
        if goal is not None and not goal.text:
            goal.text = CANCELED
        self._end(CANCELED)

    def _end(self, text: str) -> None:
        """End the goal of this page intentionally, and release control."""
        if self._mine is not None:
            self._stand_still(text)
            self.give()

    def _stand_still(self, text: str) -> None:
        """End the goal of this page, and publish zero unless somebody else drives."""
        goal, self._mine = self._mine, None
        if goal is None:
            return
        goal.text = goal.text or text
        if self.link.mover is self:
            self._say(STILL)
