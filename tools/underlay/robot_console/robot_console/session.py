# SPDX-License-Identifier: Apache-2.0
"""What talks to one small page."""

from __future__ import annotations

from collections.abc import Callable, Mapping
import time
from typing import Any

from robot_console.robot_link import RobotLink

__all__ = ['Session']


class Session:
    """
    What talks to one small page in a browser.

    A page sends what it wants, as `{'do': ...}`, and gets the state of things as an answer. What
    it may do are the methods that `actions` names. All is done in the thread of the page.

    Parameters
    ----------
    link
        The link to the robot that the page is about.
    person
        Who has the page open, as others are told.

    """

    def __init__(self, link: RobotLink, person: str) -> None:
        self.link = link
        self.person = person
        self._farewells = 0
        self._heard_s = time.monotonic()
        self.silent_s = 0.0
        """How long nothing had come from the page before its last message."""

    @property
    def actions(self) -> Mapping[str, Callable[[Mapping[str, Any]], None]]:
        """Return what the page may do."""
        raise NotImplementedError

    @property
    def is_watched(self) -> bool:
        """Tell whether the page must give signs of life."""
        return self.link.control.holds(self)

    def take(self, message: Any) -> dict[str, Any]:
        """
        Run the action that the page asks for, then publish the heartbeat if it is due.

        Parameters
        ----------
        message
            The decoded JSON, such as `{'do': 'beat'}`; the whole mapping is passed to the action.

        Returns
        -------
        dict
            The state that the page is to show, which can be written as JSON.

        Raises
        ------
        ValueError
            There is no such action, or it rejects what the message contains.

        """
        do = message.get('do') if isinstance(message, dict) else None
        action = self.actions.get(do) if isinstance(do, str) else None
        if action is None:
            raise ValueError(f'A page cannot do this here: {str(message)[:50]}')
        now_s = time.monotonic()
        self.silent_s, self._heard_s = now_s - self._heard_s, now_s
        action(message)
        self._beat()
        return self.state()

    def state(self) -> dict[str, Any]:
        """Return what the page is to show."""
        return {'you': self.person, 'control': self._control()}

    def lose(self) -> None:
        """Take note that the page is gone, or gives no signs of life."""
        self.link.control.lose(self)

    def give(self) -> None:
        """Give back the control, and tell the robot that this is on purpose."""
        if self.link.control.give(self):
            self._farewells = 3

    def _beat(self) -> None:
        """Tell the robot that the page lives; a message may be lost, so each is repeated."""
        if self.link.control.holds(self):
            self.link.beat(True)
        elif self._farewells and not self.link.control.person:
            self._farewells -= 1
            self.link.beat(False)

    def _control(self) -> dict[str, Any]:
        control = self.link.control
        return {
            'who': control.person,
            'mine': control.person == self.person,
            'here': control.holds(self),
            'lost': control.lost,
        }
