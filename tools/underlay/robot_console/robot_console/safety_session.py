# SPDX-License-Identifier: Apache-2.0
"""Session of a page with the emergency stop."""

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
    """Facts about a robot, for its page."""

    kind: str = UNKNOWN
    listeners: tuple[str, ...] = ()
    """The nodes that subscribe to the emergency stop."""
    speakers: tuple[str, ...] = ()
    """The other nodes that publish the emergency stop."""
    says: str | None = None
    """The reason why the robot holds still, empty if it moves; None if it does not report it."""
    pace: float | None = None
    """The real-time factor of the simulator; None if it is not published."""


class SafetySession(Session):
    """
    Presses and releases the emergency stop, takes and releases control.

    Parameters
    ----------
    link
        The link to the robot.
    person
        The user of the page, as shown to others.
    facts
        Returns the current facts about the robot.

    """

    def __init__(self, link: RobotLink, person: str, facts: Callable[[], Facts]) -> None:
        super().__init__(link, person)
        self._facts = facts

    @property
    def actions(self) -> Mapping[str, Callable[[Mapping[str, Any]], None]]:
        """Return the actions that the page may request."""
        return {
            'beat': lambda message: None,
            'stop': lambda message: self.link.say_stop(True, self.person),
            'release': self._release,
            'take': lambda message: self._take(),
            'give': lambda message: self.give(),
        }

    def state(self) -> dict[str, Any]:
        """Return the state that the page shows."""
        return {**super().state(), 'stop': asdict(self.link.stop), **asdict(self._facts())}

    def _release(self, message: Mapping[str, Any]) -> None:
        self.link.say_stop(False, self.person)
        self.link.control.lost = ''

    def _take(self) -> None:
        self.link.control.take(self.person, self)
