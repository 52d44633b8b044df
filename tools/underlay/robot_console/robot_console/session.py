# SPDX-License-Identifier: Apache-2.0
"""Session of a control page."""

from __future__ import annotations

from collections.abc import Callable, Mapping
import time
from typing import Any

from robot_console.robot_link import RobotLink

__all__ = ['Session']


class Session:
    """
    The session of one control page in a browser.

    A page sends requests as `{'do': ...}`, and receives the state in response. The permitted
    requests are the methods in `actions`. Everything runs in the thread of the page server.

    Parameters
    ----------
    link
        The link to the robot of the page.
    person
        The user of the page, as shown to others.

    """

    def __init__(self, link: RobotLink, person: str) -> None:
        self.link = link
        self.person = person
        self._farewells = 0
        self._heard_s = time.monotonic()
        self.silent_s = 0.0
        """The time without a message from the page before its last message."""

    @property
    def actions(self) -> Mapping[str, Callable[[Mapping[str, Any]], None]]:
        """Return the actions that the page may request."""
        raise NotImplementedError

    @property
    def is_watched(self) -> bool:
        """Whether the watchdog monitors the page."""
        return self.link.control.holds(self)

    def take(self, message: Any) -> dict[str, Any]:
        """
        Run the action that the page requests, then publish the heartbeat if it is due.

        Parameters
        ----------
        message
            The decoded JSON, such as `{'do': 'beat'}`; the whole mapping is passed to the action.

        Returns
        -------
        dict
            The state that the page shows, serializable as JSON.

        Raises
        ------
        ValueError
            There is no such action, or it rejects the contents of the message.

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
        """Return the state that the page shows."""
        return {'you': self.person, 'control': self._control()}

    def lose(self) -> None:
        """Release control as lost, since the page is gone or its watchdog has expired."""
        self.link.control.lose(self)

    def give(self) -> None:
        """Release control, and inform the robot that this is intentional."""
        if self.link.control.give(self):
            self._farewells = 3

    def _beat(self) -> None:
        """Publish a heartbeat; the release of control is repeated, since messages may be lost."""
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
