# SPDX-License-Identifier: Apache-2.0
"""What happens to a robot when pages ask for it, without a robot."""

from __future__ import annotations

from typing import Any

import pytest
from robot_console.control import Control
from robot_console.panels.drive import (
    AGAIN,
    DriveSession,
    SpeedLimits,
    stalled,
    STILL,
    STOP_ENDED,
    STOPPED,
    Velocity,
)
from robot_console.panels.safety import Facts, SafetySession
from robot_console.robot_link import EmergencyStop


class Link:
    """What a link does, noted down."""

    def __init__(self) -> None:
        """Begin with nobody in control."""
        self.control = Control()
        self.stop = EmergencyStop()
        self.beats: list[bool] = []
        self.said: list[Velocity] = []
        self.facts = Facts()
        self.holds_because = ''

    def beat(self, in_control: bool) -> None:
        """Note down a heartbeat."""
        self.beats.append(in_control)

    def say_stop(self, pressed: bool, by: str) -> None:
        """Note down a stop."""
        self.stop.say(pressed, by)

    def drive(self, person: str) -> DriveSession:
        """Return a page to drive with."""
        limits = SpeedLimits(0.5, 0.3, 1.0)
        world: Any = self
        return DriveSession(world, person, limits, self.said.append, lambda: 2)

    def safety(self, person: str) -> SafetySession:
        """Return a page to stop with."""
        return SafetySession(self, person, lambda: self.facts)  # type: ignore[arg-type]


def push(press: int = 1, forward: float = 1.0) -> dict[str, Any]:
    """Return what a page sends that is held."""
    return {'do': 'drive', 'press': press, 'stick': [forward, 0, 0], 'share': [1, 1]}


@pytest.fixture
def link() -> Link:
    """Return a link to no robot."""
    return Link()


def test_drive(link: Link) -> None:
    """The robot moves while a page is held, with heartbeats, and stands still after."""
    page = link.drive('ann')
    assert page.take({'do': 'beat'})['velocity'] is None
    assert link.said == [] and link.beats == [] and not page.is_watched
    assert page.take(push())['velocity'] == (0.5, 0.0, 0.0)
    assert page.take(push(forward=0.0))['velocity'] == STILL
    assert page.is_watched and link.control.person == 'ann'
    page.take({'do': 'halt'})
    assert link.said == [(0.5, 0.0, 0.0), STILL, STILL]
    assert link.beats == [True, True, False] and link.control.person == ''
    for _ in range(5):
        page.take({'do': 'beat'})
    assert link.beats == [True, True, False, False, False], 'said thrice, then silence'
    assert len(link.said) == 3


def test_robot_that_holds_still(link: Link) -> None:
    """Who drives a robot that does not move is told why."""
    link.holds_because = 'the battery is low'
    assert link.drive('ann').take(push())['holdsBecause'] == 'the battery is low'


def test_lost_driver(link: Link) -> None:
    """With a lost page the robot stands still, and hears no heartbeat that makes it wait."""
    page = link.drive('ann')
    page.take(push())
    page.lose()
    assert link.said[-1] == STILL and link.control.lost == 'ann'
    assert link.beats == [True]
    page.lose()
    assert len(link.said) == 2


def test_press_that_was_lost(link: Link) -> None:
    """A page that comes back while it is still held is told why it has to be pressed again."""
    page = link.drive('ann')
    page.take(push(1))
    page.lose()
    page._heard_s -= 2.0
    state = page.take(push(1))
    assert state['velocity'] is None
    assert state['refusal'] == f'{stalled(2.0)} {AGAIN}' == page.take(push(1))['refusal']
    assert 'this page stalled for 2.0 s' in state['refusal']
    assert link.said[-1] == STILL and link.control.person == ''
    assert page.take(push(2))['velocity']


def test_second_driver(link: Link) -> None:
    """While one person drives, others are refused and see who it is."""
    ann, bob = link.drive('ann'), link.drive('bob')
    ann.take(push())
    state = bob.take(push())
    assert state['refusal'] == 'ann is in control.' and state['velocity'] is None
    assert not state['control']['mine'] and state['control']['who'] == 'ann'
    assert len(link.said) == 1
    bob.take({'do': 'halt'})
    bob.lose()
    assert link.control.person == 'ann' and len(link.said) == 1
    ann.take({'do': 'halt'})
    assert bob.take(push())['velocity']


def test_stop_ends_driving(link: Link) -> None:
    """A stop ends the press; after its release one has to press again."""
    page = link.drive('ann')
    page.take(push(1))
    link.safety('bob').take({'do': 'stop'})
    assert page.take(push(1))['refusal'] == STOPPED
    assert link.said[-1] == STILL and link.control.person == ''
    link.safety('bob').take({'do': 'release'})
    assert page.take(push(1))['refusal'] == f'{STOP_ENDED} {AGAIN}'
    assert page.take(push(2))['velocity']


def test_stop_and_release(link: Link) -> None:
    """Everybody may stop and release, whoever is in control."""
    ann, bob = link.safety('ann'), link.safety('bob')
    ann.take({'do': 'take'})
    state = bob.take({'do': 'stop'})
    assert state['stop'] == {'pressed': True, 'by': 'bob', 'heard': True}
    assert ann.take({'do': 'release'})['stop'] == {'pressed': False, 'by': 'ann', 'heard': True}


def test_take_and_give(link: Link) -> None:
    """Who takes control gives heartbeats, until it is given back."""
    ann, bob = link.safety('ann'), link.safety('bob')
    ann.take({'do': 'beat'})
    assert link.beats == []
    state = ann.take({'do': 'take'})
    assert state['control'] == {'who': 'ann', 'mine': True, 'here': True, 'lost': ''}
    assert bob.take({'do': 'take'})['control']['who'] == 'ann'
    assert link.beats == [True], 'a bystander is no sign of life'
    ann.take({'do': 'give'})
    assert link.beats == [True, False]


def test_no_farewell_while_another_is_in_control(link: Link) -> None:
    """Who gave control back does not speak for the next one."""
    ann, bob = link.safety('ann'), link.safety('bob')
    ann.take({'do': 'take'})
    ann.take({'do': 'give'})
    bob.take({'do': 'take'})
    ann.take({'do': 'beat'})
    assert link.beats == [True, False, True]


def test_no_farewell_after_another_was_lost(link: Link) -> None:
    """Nor does the first one for itself: a farewell is over once somebody takes control."""
    ann, bob = link.safety('ann'), link.safety('bob')
    for page in (ann, bob):
        ann.take({'do': 'take'})
        ann.take({'do': 'give'})
        page.take({'do': 'take'})
        page.lose()
        link.beats.clear()
        ann.take({'do': 'beat'})
        assert link.beats == []


def test_drive_and_watch_together(link: Link) -> None:
    """A person in control may drive; letting go of the stick does not end the control."""
    safety, drive = link.safety('ann'), link.drive('ann')
    safety.take({'do': 'take'})
    drive.take(push())
    drive.take({'do': 'halt'})
    assert link.control.person == 'ann' and False not in link.beats
    drive.take(push(2))
    safety.lose()
    assert link.control.lost == 'ann' and drive.is_watched
    drive.lose()
    assert link.said[-1] == STILL


@pytest.mark.parametrize(
    'message', [None, 1, [], {}, {'do': 'fly'}, {'do': ['beat']}, {'do': 'drive', 'stick': 'x'}]
)
def test_wrong_messages(link: Link, message: Any) -> None:
    """What a page cannot ask for is refused and moves nothing."""
    with pytest.raises(ValueError):
        link.drive('ann').take(message)
    assert link.said == [] and link.beats == [] and link.control.person == ''
