# SPDX-License-Identifier: Apache-2.0
"""Session of a page that drives a robot."""

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
    Drives a robot while a page repeats its request, which it does while the stick is held.

    Requests carry the number of their press. Once a press has ended, for whatever reason, its
    requests no longer move the robot.

    Parameters
    ----------
    link
        The link to the robot, with its emergency stop and its control arbitration.
    person
        The user of the page, as shown to others.
    limits
        The speeds at full deflection of the stick.
    say
        Publishes a velocity command of the base.
    count_listeners
        Returns the number of subscribers to the velocity command, which the page shows.

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
        """Return the actions that the page may request."""
        return {'beat': self._rest, 'halt': self._rest, 'drive': self._drive}

    @property
    def is_watched(self) -> bool:
        """Whether the watchdog monitors the page."""
        return self._velocity is not None or super().is_watched

    def state(self) -> dict[str, Any]:
        """Return the state that the page shows."""
        velocity, refusal = self._velocity, self._refusal
        return {
            **super().state(),
            'velocity': velocity,
            'refusal': refusal,
            'listeners': self._count_listeners(),
            'holdsBecause': self.link.holds_because,
        }

    def lose(self) -> None:
        """Stop the robot, since the page is lost or its watchdog has expired."""
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
        """Take control, or return the reason why driving is rejected."""
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
        """Stop intentionally, and release control."""
        self._stand_still()
        self.give()

    def _stand_still(self) -> None:
        """End this press, and publish zero velocity if the robot was driven."""
        if self._velocity is not None:
            self._velocity = None
            self._ended = self._press
            self._why_ended = STOP_ENDED if self.link.stop.pressed else ''
            self._say(STILL)


def stalled(silent_s: float) -> str:
    """
    Explain to the user that the robot was stopped because the page stalled.

    Parameters
    ----------
    silent_s
        The time without a message from the page, in s.

    """
    return (
        f'The robot was stopped: this page stalled for {silent_s:.1f} s. '
        'This computer, or the network, is too busy.'
    )
