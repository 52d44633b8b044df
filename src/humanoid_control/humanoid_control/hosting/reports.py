# SPDX-License-Identifier: Apache-2.0
"""Reports in the log: falls, obstacles, and rejected commands without repetition."""

from __future__ import annotations

from collections.abc import Callable
import math
import time
from typing import Protocol

FALLEN = (
    'has fallen, and its joints are limp. It soon gets up by itself, unless a stop or the '
    'parameter walk.fall.get_up forbids it. In simulation, the service '
    "'stand_up' lifts it at once."
)
GIVEN_UP = (
    'has not managed to get up: it stays limp until it is stood up. Move what it lies on or what '
    "is in its way; in simulation, call the service 'stand_up'."
)
BLOCKED = (
    'Something is in the way. It steps back and does not walk in that direction: turn it, walk '
    'another way, or let go for half a second to try again.'
)
QUIET_S = 5.0
"""A message that has not come for this time is logged again."""
MOST_MESSAGES = 10
"""Maximum number of different messages that are logged in that time; more are a flood."""


class Log(Protocol):
    """Logger for the messages."""

    def error(self, message: str) -> object:
        """
        Log an error message.

        Parameters
        ----------
        message
            Description of the problem, and what to do.

        """

    def warning(self, message: str) -> object:
        """
        Log a warning message.

        Parameters
        ----------
        message
            Description of the limitation, and what to do.

        """

    def info(self, message: str) -> object:
        """
        Log an informational message.

        Parameters
        ----------
        message
            What is to be reported.

        """


class FallReport:
    """
    Reporter that logs when a robot falls, gives up getting up, and stands again.

    Parameters
    ----------
    log
        The logger; a fall and giving up are logged as errors.
    robot
        Name of the robot, for the messages; empty if it is alone.

    """

    def __init__(self, log: Log, robot: str) -> None:
        self._log = log
        self._who = f"The robot '{robot}'" if robot else 'The robot'
        self._was_down = self._had_given_up = False

    def look(self, is_down: bool, has_given_up: bool = False) -> None:
        """
        Log what has changed since the last call.

        Parameters
        ----------
        is_down
            Whether the robot lies, falls, gets up or is being put onto its feet.
        has_given_up
            Whether it lies and no longer tries to get up.

        """
        if has_given_up and not self._had_given_up:
            self._log.error(f'{self._who} {GIVEN_UP}')
        self._had_given_up = has_given_up
        if is_down == self._was_down:
            return
        self._was_down = is_down
        if is_down:
            self._log.error(f'{self._who} {FALLEN}')
        else:
            self._log.info(f'{self._who} stands again.')


class ObstacleReport:
    """
    Reporter that logs a warning when a robot becomes blocked.

    Parameters
    ----------
    log
        The logger.
    robot
        Name of the robot, for the message; empty if it is alone.

    """

    def __init__(self, log: Log, robot: str) -> None:
        self._log = log
        self._who = f"The robot '{robot}' is blocked." if robot else 'The robot is blocked.'
        self._was_blocked = False

    def look(self, is_blocked: bool) -> None:
        """
        Log a warning when the robot becomes blocked.

        Parameters
        ----------
        is_blocked
            Whether something is in the way now.

        """
        if is_blocked and not self._was_blocked:
            self._log.warning(f'{self._who} {BLOCKED}')
        self._was_blocked = is_blocked


class Refusals:
    """
    Rate-limited log of rejected commands, which repeats no message at short intervals.

    Parameters
    ----------
    say
        Logs a message.
    clock
        Returns the time of a steady clock in s.

    """

    def __init__(
        self, say: Callable[[str], None], clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._say, self._clock = say, clock
        self._heard_s: dict[str, float] = {}
        self._since_s, self._count = clock(), 0

    def add(self, sentence: str) -> None:
        """
        Log the rejection of a command, unless the same message came a short while ago.

        A message that comes again within `QUIET_S` is dropped, and of different ones no more than
        `MOST_MESSAGES` are logged in that time.

        Parameters
        ----------
        sentence
            The message: why the command is rejected, and what to do.

        """
        now_s = self._clock()
        is_new = now_s - self._heard_s.get(sentence, -math.inf) >= QUIET_S
        if len(self._heard_s) > MOST_MESSAGES:
            self._heard_s.clear()
        self._heard_s[sentence] = now_s
        if is_new:
            self._say_some(sentence, now_s)

    def _say_some(self, sentence: str, now_s: float) -> None:
        """Log a new message, unless many have been logged in a short time."""
        if now_s - self._since_s >= QUIET_S:
            self._since_s, self._count = now_s, 0
        self._count += 1
        if self._count <= MOST_MESSAGES:
            self._say(sentence)
        if self._count == MOST_MESSAGES:
            self._say(f'Too many rejections: further ones are not logged for {QUIET_S:g} s.')
