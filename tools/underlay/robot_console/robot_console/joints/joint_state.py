# SPDX-License-Identifier: Apache-2.0
"""The joint states received on a topic."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf, isfinite

__all__ = ['JointState', 'JointStates']

MAX_JOINTS = 1000
FORGET_S = 60.0
Numbers = Sequence[float]


@dataclass(frozen=True)
class JointState:
    """State of a joint (rad or m, per second, N m or N); unknown quantities are None."""

    position: float | None = None
    velocity: float | None = None
    effort: float | None = None
    at_s: float = -inf


class JointStates:
    """
    The latest state of each joint, received on a topic.

    Several publishers may each cover some of the joints. Messages are only processed when the
    states are requested, so that high message rates cost little.
    """

    def __init__(self) -> None:
        self.received = 0
        self.last_s: float | None = None
        self.complaint = ''
        self._waiting: dict[tuple[str, ...], tuple[Numbers, Numbers, Numbers, float]] = {}
        self._states: dict[str, JointState] = {}

    def take(
        self,
        names: Sequence[str],
        positions: Numbers,
        velocities: Numbers,
        efforts: Numbers,
        now_s: float,
    ) -> None:
        """
        Store a message; it is only processed when `states` is requested.

        Parameters
        ----------
        names
            The joints.
        positions, velocities, efforts
            One number per name (rad or m, per second, N m or N), or empty. Lists of another length
            are ignored, which `complaint` reports.
        now_s
            The time of reception, from `time.time`.

        """
        self.received += 1
        self.last_s = now_s
        if len(self._waiting) > MAX_JOINTS:
            self._look()
        self._waiting[tuple(names)] = positions, velocities, efforts, now_s

    @property
    def states(self) -> Mapping[str, JointState]:
        """Return the states of the joints that were received in the last minute."""
        if self._waiting:
            self._look()
        return self._states

    def _look(self) -> None:
        """Process the stored messages; lists whose length does not match the names are ignored."""
        waiting, self._waiting = self._waiting, {}
        for names, (positions, velocities, efforts, at_s) in waiting.items():
            lists = {'positions': positions, 'velocities': velocities, 'efforts': efforts}
            self.complaint = _complaint(names, lists)
            for index, name in enumerate(names):
                if len(self._states) >= MAX_JOINTS and name not in self._states:
                    self.complaint = f'There are more than {MAX_JOINTS} joints.'
                    break
                position, velocity, effort = (
                    _number(each, index, len(names)) for each in lists.values()
                )
                self._states[name] = JointState(position, velocity, effort, at_s)
        newest_s = self.last_s or 0.0
        self._states = {
            name: state for name, state in self._states.items() if newest_s - state.at_s < FORGET_S
        }


def _number(numbers: Numbers, index: int, count: int) -> float | None:
    """Return one of the numbers, or None if it is not finite or the list length does not match."""
    if len(numbers) != count or not isfinite(numbers[index]):
        return None
    return float(numbers[index])


def _complaint(names: Sequence[str], lists: Mapping[str, Numbers]) -> str:
    for what, numbers in lists.items():
        if len(numbers) not in (0, len(names)):
            return (
                f'A message has {len(names)} names but {len(numbers)} {what}, which are left out.'
            )
    return ''
