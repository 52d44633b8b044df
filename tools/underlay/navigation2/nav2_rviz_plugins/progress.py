# SPDX-License-Identifier: Apache-2.0
"""Progress of a goal, and its description; independent of ROS."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from typing import Any

__all__ = ['ACTIONS', 'THROUGH', 'TO_POSE', 'WAYPOINTS', 'Goal', 'Phase', 'outcome']

TO_POSE, THROUGH, WAYPOINTS = 'navigate_to_pose', 'navigate_through_poses', 'follow_waypoints'
ACTIONS = {
    TO_POSE: 'Navigate to pose',
    THROUGH: 'Navigate through poses',
    WAYPOINTS: 'Follow waypoints',
}
"""The monitored actions, with their titles."""


class Phase(Enum):
    """Phase of a goal."""

    SENDING = 'sending'
    ACCEPTED = 'accepted'
    EXECUTING = 'executing'
    CANCELING = 'canceling'
    SUCCEEDED = 'succeeded'
    CANCELED = 'canceled'
    ABORTED = 'aborted'
    FAILED = 'failed'
    """The goal was not delivered or was rejected, or the server is gone."""

    @property
    def is_over(self) -> bool:
        """Whether the phase is final."""
        return self in (Phase.SUCCEEDED, Phase.CANCELED, Phase.ABORTED, Phase.FAILED)


PHASES = {
    1: Phase.ACCEPTED,
    2: Phase.EXECUTING,
    3: Phase.CANCELING,
    4: Phase.SUCCEEDED,
    5: Phase.CANCELED,
    6: Phase.ABORTED,
}
"""The phases by the values of `action_msgs/msg/GoalStatus`."""


@dataclass
class Goal:
    """Goal of one of the actions, from any client."""

    action: str
    goal_id: bytes = b''
    phase: Phase = Phase.SENDING
    text: str = ''
    """The reason for its end, or other information."""
    poses: int = 0
    """The number of its poses, if it was sent from this page."""
    numbers: dict[str, float] = field(default_factory=dict)
    """The values of the newest feedback: metres, seconds, counts."""
    missed: list[int] = field(default_factory=list)
    """The indices of missed waypoints, from 0."""
    is_own: bool = False

    def take_feedback(self, feedback: Any) -> None:
        """
        Store the values of a feedback message, in m, s or as counts.

        Parameters
        ----------
        feedback
            The feedback message of any of the `ACTIONS`.

        """
        for name in ('navigation_time', 'estimated_time_remaining'):
            if hasattr(feedback, name):
                duration = getattr(feedback, name)
                self.numbers[name] = duration.sec + duration.nanosec * 1e-9
        for name in (
            'distance_remaining',
            'number_of_recoveries',
            'number_of_poses_remaining',
            'current_waypoint',
        ):
            if hasattr(feedback, name):
                self.numbers[name] = float(getattr(feedback, name))

    def take_result(self, result: Any) -> None:
        """
        Store the result of the goal; `phase` has to be set before.

        Parameters
        ----------
        result
            The result message of any of the `ACTIONS`.

        """
        self.missed = [int(each.index) for each in getattr(result, 'missed_waypoints', ())]
        code, reason = int(result.error_code), getattr(result, 'error_msg', '')
        self.text = outcome(self.phase, code, reason, self.missed)

    def told(self) -> dict[str, Any]:
        """Return the progress to show on the page."""
        return {
            'title': ACTIONS[self.action],
            'action': self.action,
            'phase': self.phase.value,
            'over': self.phase.is_over,
            'text': self.text,
            'poses': self.poses,
            'numbers': dict(self.numbers),
            'missed': list(self.missed),
            'own': self.is_own,
        }


def outcome(phase: Phase, code: int, reason: str, missed: list[int]) -> str:
    """
    Describe the outcome of a goal.

    Parameters
    ----------
    phase
        The final phase.
    code, reason
        The `error_code` and `error_msg` of the result; 0 is no error.
    missed
        The indices of missed waypoints, from 0; the text numbers them from 1.

    """
    reason = reason.strip()
    said = []
    if phase is Phase.ABORTED:
        said.append(reason or 'The server gave no reason.')
        if code:
            said.append(f'(error code {code})')
    elif reason:
        said.append(reason)
    if missed:
        numbers = ', '.join(str(index + 1) for index in missed)
        said.append(f'Missed waypoints: {numbers}.')
    elif phase is Phase.SUCCEEDED and not reason:
        said.append('The goal is reached.')
    return ' '.join(said)
