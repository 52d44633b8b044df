# SPDX-License-Identifier: Apache-2.0
"""Motion inhibition: whether the robot may be sent to a goal, and if not, why."""

from __future__ import annotations

FALLEN = (
    'The robot has fallen. Wait until it has got up, or stand it up; in simulation, call the '
    'service stand_up.'
)
STANDING_UP = 'The robot is still standing up. Send the goal again once it stands.'


class Inhibition:
    """Motion inhibition, from the walking state and the stop state of the robot."""

    def __init__(self) -> None:
        self._walking = ''
        self._stopped = ''

    @property
    def reason(self) -> str:
        """Return why the robot cannot be sent to a goal, as a message; empty if it can."""
        if self._stopped:
            return f'The robot holds still: {self._stopped}.'
        return {'fallen': FALLEN, 'stand_up': STANDING_UP}.get(self._walking, '')

    def tell_walking_state(self, state: str) -> None:
        """
        Update the walking state.

        Parameters
        ----------
        state
            The value of the topic `walking_state`; `fallen` and `stand_up` inhibit motion.

        """
        self._walking = state

    def tell_stop_state(self, reason: str) -> None:
        """
        Update the reason for a stop.

        Parameters
        ----------
        reason
            The value of the topic `stop_state`: why the robot holds still; empty if it may move.

        """
        self._stopped = reason
