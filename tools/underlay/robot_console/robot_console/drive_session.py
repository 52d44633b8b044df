# SPDX-License-Identifier: Apache-2.0
"""Driving a robot from a small page."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from robot_console.robot_link import RobotLink
from robot_console.session import Session
from robot_console.speed_limits import SpeedLimits, STILL, Velocity

__all__ = ['DriveSession']

STOPPED = 'The emergency stop is pressed.'
STOP_ENDED = 'The emergency stop has ended this.'
AGAIN = 'Let go, and press again.'


class DriveSession(Session):
    """
    Drives a robot as long as a page asks for it again and again, which it does while it is held.

    What the page asks for is numbered by presses. A press that has ended, for whatever reason,
    moves nothing any more.

    Parameters
    ----------
    link
        The link to the robot, with its emergency stop and who is in control.
    person
        Who has the page open, as others are told.
    limits
        The speeds at full deflection of the stick.
    say
        Publishes a velocity of the base.
    count_listeners
        Returns the number of subscribers of that velocity, which the page shows.

    """

    def __init__(
        self,
        link: RobotLink,
        person: str,
        limits: SpeedLimits,
        say: Callable[[Velocity], None],
        count_listeners: Callable[[], int],
    ) -> None:
        super().__init__(link, person)
        self._limits = limits
        self._say = say
        self._count_listeners = count_listeners
        self._velocity: Velocity | None = None
        self._press: Any = None
        self._ended: Any = None
        self._why_ended = ''
        self._is_lost = False
        self._refusal = ''

    @property
    def actions(self) -> Mapping[str, Callable[[Mapping[str, Any]], None]]:
        """Return what the page may do."""
        return {'beat': self._rest, 'halt': self._rest, 'drive': self._drive}

    @property
    def is_watched(self) -> bool:
        """Tell whether the page must give signs of life."""
        return self._velocity is not None or super().is_watched

    def state(self) -> dict[str, Any]:
        """Return what the page is to show."""
        velocity, refusal = self._velocity, self._refusal
        return {
            **super().state(),
            'velocity': velocity,
            'refusal': refusal,
            'listeners': self._count_listeners(),
            'holdsBecause': self.link.holds_because,
        }

    def lose(self) -> None:
        """Stop the robot, since the page is gone or gives no signs of life."""
        self._is_lost |= self._velocity is not None
        self._stand_still()
        super().lose()

    def _drive(self, message: Mapping[str, Any]) -> None:
        velocity = self._limits.velocity(message.get('stick'), message.get('share'))
        self._press = message.get('press')
        if self._is_lost:
            self._is_lost, self._why_ended = False, stalled(self.silent_s)
        self._refusal = self._why_not()
        if self._refusal:
            self._stop()
        else:
            self._velocity = velocity
            self._say(velocity)

    def _why_not(self) -> str:
        """Take control, or return why the robot is not to be driven."""
        if self.link.stop.pressed:
            return STOPPED
        if self._ended is not None and self._press == self._ended:
            return f'{self._why_ended} {AGAIN}'.lstrip()
        if not self.link.control.take(self.person, self):
            return f'{self.link.control.person} is in control.'
        return ''

    def _rest(self, message: Mapping[str, Any]) -> None:
        self._refusal = STOPPED if self.link.stop.pressed else ''
        self._stop()

    def _stop(self) -> None:
        """Stop on purpose."""
        self._stand_still()
        self.give()

    def _stand_still(self) -> None:
        """End this press, with a velocity of zero if the robot was driven."""
        if self._velocity is not None:
            self._velocity = None
            self._ended = self._press
            self._why_ended = STOP_ENDED if self.link.stop.pressed else ''
            self._say(STILL)


def stalled(silent_s: float) -> str:
    """
    Explain to a person why the robot was stopped: the page that drove it stalled.

    Parameters
    ----------
    silent_s
        For how long nothing came from the page, in s.

    """
    return (
        f'The robot was stopped: this page stalled for {silent_s:.1f} s. '
        'This computer, or the network, is too busy.'
    )
