# SPDX-License-Identifier: Apache-2.0
"""Reports in the log that an obstacle blocks a robot."""

from __future__ import annotations

from typing import Protocol

BLOCKED = (
    'Something is in the way. It steps back and goes no further in that direction: turn it, walk '
    'another way, or let go for half a second to try again.'
)


class Log(Protocol):
    """Logger for the messages."""

    def warning(self, message: str) -> object:
        """
        Log a warning message.

        Parameters
        ----------
        message
            Description of the limitation, and what to do.

        """


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
