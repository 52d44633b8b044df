# SPDX-License-Identifier: Apache-2.0
"""Reports in the log that a robot has fallen, and that it stands again."""

from __future__ import annotations

from typing import Protocol

FALLEN = (
    'has fallen, and its joints give way until it is put onto its feet. '
    "In a simulation, call the service 'stand_up'."
)


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
    Reporter that logs a message when a robot falls, and one when it stands again.

    Parameters
    ----------
    log
        The logger; a fall is logged as an error.
    robot
        Name of the robot, for the messages; empty if it is alone.

    """

    def __init__(self, log: Log, robot: str) -> None:
        self._log = log
        self._who = f"The robot '{robot}'" if robot else 'The robot'
        self._was_down = False

    def look(self, is_down: bool) -> None:
        """
        Log a fall, or that the robot stands again, when that has changed since the last call.

        Parameters
        ----------
        is_down
            Whether the robot lies, falls or is being put onto its feet.

        """
        if is_down == self._was_down:
            return
        self._was_down = is_down
        if is_down:
            self._log.error(f'{self._who} {FALLEN}')
        else:
            self._log.info(f'{self._who} stands again.')
