# SPDX-License-Identifier: Apache-2.0
"""Stopping a robot from a small page."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from typing import Any

from robot_console.robot_kind import UNKNOWN
from robot_console.robot_link import RobotLink
from robot_console.session import Session

__all__ = ['Facts', 'SafetySession']


@dataclass(frozen=True)
class Facts:
    """What is known of a robot."""

    kind: str = UNKNOWN
    listeners: tuple[str, ...] = ()
    """The nodes that hear the emergency stop."""
    speakers: tuple[str, ...] = ()
    """The nodes besides this one that may press or release it."""
    says: str | None = None
    """Why the robot holds still, empty if it moves; None if it does not say."""
    pace: float | None = None
    """How many seconds of a simulated world pass in a real one; None if nobody says so."""


class SafetySession(Session):
    """
    Presses the emergency stop and releases it, takes control and gives it back.

    Parameters
    ----------
    link
        The link to the robot.
    person
        Who has the page open, as others are told.
    facts
        Returns what is known of the robot at the moment.

    """

    def __init__(self, link: RobotLink, person: str, facts: Callable[[], Facts]) -> None:
        super().__init__(link, person)
        self._facts = facts

    @property
    def actions(self) -> Mapping[str, Callable[[Mapping[str, Any]], None]]:
        """Return what the page may do."""
        return {
            'beat': lambda message: None,
            'stop': lambda message: self.link.say_stop(True, self.person),
            'release': self._release,
            'take': lambda message: self._take(),
            'give': lambda message: self.give(),
        }

    def state(self) -> dict[str, Any]:
        """Return what the page is to show."""
        return {**super().state(), 'stop': asdict(self.link.stop), **asdict(self._facts())}

    def _release(self, message: Mapping[str, Any]) -> None:
        self.link.say_stop(False, self.person)
        self.link.control.lost = ''

    def _take(self) -> None:
        self.link.control.take(self.person, self)
