# SPDX-License-Identifier: Apache-2.0
"""A walk obeys the rules of driving, whoever clicks, stops, drives or leaves."""

from __future__ import annotations

from dataclasses import replace
import math
import time
from typing import Any

import pytest
from robot_console.control import Control
from robot_console.panels.drive import DriveSession, SpeedLimits, STILL, STOPPED, Velocity
from robot_console.robot_link import EmergencyStop
from robot_console.walk_here import walk_session
from robot_console.walk_here.straight_walk import Place, Target
from robot_console.walk_here.walk_session import present_goal, RobotNow, WalkGoal, WalkSession

LIMITS = SpeedLimits(0.3, 0.0, 0.6)


class World:
    """A robot that notes down its commands, the people of its pages, and what was clicked."""

    def __init__(self) -> None:
        """Begin with a robot at the origin, and nobody in control."""
        self.control = Control()
        self.stop = EmergencyStop()
        self.holds_because = ''
        self.mover: object = None
        self.said: list[Velocity] = []
        self.beats: list[bool] = []
        self.goals: list[WalkGoal] = []
        self.now: RobotNow | None = RobotNow(Place(0.0, 0.0, 0.0), 1.0, time.monotonic())

    def beat(self, in_control: bool) -> None:
        """Note down a heartbeat."""
        self.beats.append(in_control)

    def goal(self) -> WalkGoal | None:
        """Return the goal that pages show."""
        return present_goal(self.goals)

    def page(self, person: str) -> WalkSession:
        """Return a page."""
        link: Any = self
        return WalkSession(link, person, LIMITS, self.said.append, self.goal, lambda: self.now)

    def click(self) -> dict[str, Any]:
        """Click two metres ahead; return what the page sends then."""
        self.goals.append(WalkGoal(Target(2.0, 0.0), browser=3))
        return {'do': 'walk', 'number': self.goals[-1].number}


@pytest.fixture
def world(monkeypatch: pytest.MonkeyPatch) -> World:
    """Return a robot, whose state stays new however long the test takes."""
    for name in ('STALE_S', 'TAKE_S'):
        monkeypatch.setattr(walk_session, name, 100.0)
    return World()


def test_to_the_end(world: World) -> None:
    """The page that takes the goal is in control, and walks until it arrives."""
    page = world.page('ann')
    assert page.take({'do': 'beat'})['goal'] is None
    walk = world.click()
    state = page.take({'do': 'beat'})
    assert (state['waiting'], state['browser']) == (walk['number'], 3)
    state = page.take(walk)
    assert (state['waiting'], state['browser']) == (0, None)
    assert state['goal']['distance'] == 2.0 and state['goal']['who'] == 'ann'
    assert world.said == [Velocity(0.3, 0.0, 0.0)] and world.control.person == 'ann'
    assert page.is_watched and world.beats == [True]
    assert world.now is not None
    world.now = replace(world.now, place=Place(1.95, 0.0, 0.0))
    assert page.take(walk)['goal']['text'] == 'Arrived.'
    assert world.said[-1] == STILL and world.control.person == '' and not page.is_watched
    page.take(walk)
    assert len(world.said) == 2, 'what is over stays over'


@pytest.mark.parametrize(
    ('change', 'said'),
    [
        ({'walking': 'fallen'}, 'The robot has fallen, 2.0 m before the place.'),
        ({'walking': 'blocked'}, 'An obstacle is in the way, 2.0 m before the place.'),
        ({'heard_s': -math.inf}, 'Stopped: the odometry of the robot is missing.'),
        ({'time_s': 1000.0}, 'Stopped: it took too long, 2.0 m before the place.'),
    ],
)
def test_it_ends_early(world: World, change: dict[str, Any], said: str) -> None:
    """The robot stands still at once, and the page says why."""
    page, walk = world.page('ann'), world.click()
    page.take(walk)
    assert world.now is not None
    world.now = replace(world.now, **change)
    assert page.take(walk)['goal']['text'] == said
    assert world.said[-1] == STILL and world.control.person == ''


def test_stop_and_hold(world: World) -> None:
    """The emergency stop ends a walk, and a robot that holds still does not begin one."""
    page, walk = world.page('ann'), world.click()
    page.take(walk)
    world.stop.say(True, 'bob')
    assert page.take(walk)['goal']['text'] == STOPPED
    assert world.said[-1] == STILL
    world.stop.say(False, 'bob')
    page.take(walk)
    assert len(world.said) == 2, 'a release does not go on with it'
    world.holds_because = 'the battery is low'
    assert 'the battery is low' in page.take(world.click())['goal']['text']


def test_a_blocked_robot_can_turn_away(world: World) -> None:
    """An obstacle ends a walk only on the way ahead."""
    assert world.now is not None
    world.now = replace(world.now, place=Place(0.0, 0.0, 3.0), walking='blocked')
    page, walk = world.page('ann'), world.click()
    assert page.take(walk)['goal']['text'] == '' and world.said == [Velocity(0.0, 0.0, -0.6)]
    world.now = replace(world.now, place=Place(0.0, 0.0, 0.0))
    page.take(walk)
    assert 'An obstacle is in the way' in page.take(walk)['goal']['text']


def test_lost_page(world: World) -> None:
    """The robot stands still, and hears no heartbeat that makes it wait."""
    page, walk = world.page('ann'), world.click()
    page.take(walk)
    page.lose()
    assert world.said[-1] == STILL and world.control.lost == 'ann' and world.beats == [True]
    assert world.page('bob').state()['goal']['text'] == (
        'Stopped: the page of ann was lost, or stalled.'
    )


def test_two_people(world: World) -> None:
    """A click of another person is refused, and does not end the walk; Stop walking does."""
    ann, bob = world.page('ann'), world.page('bob')
    walk = world.click()
    ann.take(walk)
    assert bob.take(walk)['goal']['who'] == 'ann', 'it is taken'
    refused = world.click()
    state = bob.take(refused)
    assert state['refusal'] == 'ann is in control.' and state['refused'] == refused['number']
    assert state['goal']['number'] == walk['number'], 'bob still sees how far ann is'
    assert ann.take(walk)['goal']['text'] == '' and world.said[-1].forward_m_s
    bob.take({'do': 'cancel'})
    assert ann.take(walk)['goal']['text'] == 'Stopped.'
    assert world.said[-1] == STILL and world.control.person == ''
    assert bob.take(world.click())['refused'] == 0


def test_another_click(world: World) -> None:
    """The person who walks is told of another click meanwhile, and may walk there instead."""
    page, walk = world.page('ann'), world.click()
    page.take(walk)
    other = world.click()
    state = page.take(walk)
    assert state['goal']['number'] == walk['number'] and state['waiting'] == other['number']
    state = page.take(other)
    assert state['goal']['number'] == other['number'] and state['goal']['text'] == ''
    assert world.goals[0].text and world.said[-1].forward_m_s


def test_the_stick_takes_over(world: World) -> None:
    """Who drives and walks at once drives; the end of the walk does not stop the robot."""
    link: Any = world
    page, walk = world.page('ann'), world.click()
    page.take(walk)
    drive = DriveSession(link, 'ann', LIMITS, world.said.append, lambda: 1)
    drive.take({'do': 'drive', 'press': 1, 'stick': [0.5, 0, 0], 'share': [1, 1]})
    assert page.take(walk)['goal']['text'] == 'Ended: somebody drives the robot.'
    assert world.said[-1] == Velocity(0.15, 0.0, 0.0) and world.control.person == 'ann'


def test_click_that_no_page_takes(world: World, monkeypatch: pytest.MonkeyPatch) -> None:
    """After a while the click is void, so that nothing walks by surprise."""
    page, walk = world.page('ann'), world.click()
    monkeypatch.setattr(walk_session, 'TAKE_S', -1.0)
    assert 'Click again' in page.take({'do': 'beat'})['goal']['text']
    page.take(walk)
    assert world.said == []


def test_refused_click(world: World) -> None:
    """A click that was refused from the start cannot be taken."""
    world.goals.append(WalkGoal(Target(0.0, 0.0), 'Navigation is running.'))
    page = world.page('ann')
    page.take({'do': 'walk', 'number': world.goals[-1].number})
    assert page.state()['goal']['text'] == 'Navigation is running.' and world.said == []
