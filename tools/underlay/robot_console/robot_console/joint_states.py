# SPDX-License-Identifier: Apache-2.0
"""What was received on a topic of joint states, and how late it is; without ROS."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf, isfinite

__all__ = ['JointState', 'JointStates', 'TopicWatch']

MAX_JOINTS = 1000
FORGET_S = 60.0
Numbers = Sequence[float]

LATE_S = 1.0


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
        complaint = ''
        for names, (positions, velocities, efforts, at_s) in waiting.items():
            lists = {'positions': positions, 'velocities': velocities, 'efforts': efforts}
            complaint = complaint or _complaint(names, lists)
            for index, name in enumerate(names):
                if len(self._states) >= MAX_JOINTS and name not in self._states:
                    complaint = f'There are more than {MAX_JOINTS} joints.'
                    break
                position, velocity, effort = (
                    _number(each, index, len(names)) for each in lists.values()
                )
                self._states[name] = JointState(position, velocity, effort, at_s)
        self.complaint = complaint
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
                f'A message has {len(names)} names but {len(numbers)} {what}, which are ignored.'
            )
    return ''


class TopicWatch:
    """
    Status message of a joint topic: its message rate, or why no messages arrive.

    Parameters
    ----------
    topic
        The fully qualified name of the topic.
    states
        The store of its messages, which counts them.

    """

    def __init__(self, topic: str, states: JointStates) -> None:
        self.topic = topic
        self._states = states
        self._since: tuple[float, int] | None = None
        self._rate_hz = 0.0

    def is_late(self, now_s: float) -> bool:
        """
        Check whether no message has arrived for a second.

        Parameters
        ----------
        now_s
            The current time, from `time.time`.

        """
        last_s = self._states.last_s
        return last_s is None or now_s - last_s >= LATE_S

    def sentence(self, now_s: float, publishers: int) -> str:
        """
        Format the status of the topic: joints and message rate, or the duration of silence.

        Parameters
        ----------
        now_s
            The current time, from `time.time`.
        publishers
            The number of publishers of the topic; used only if it is silent.

        """
        self._count(now_s)
        if not self.is_late(now_s):
            count = len(self._states.states)
            return f'{self.topic}: {count} joints, {self._rate_hz:.0f} messages per second'
        last_s = self._states.last_s
        return _missing(self.topic, None if last_s is None else now_s - last_s, publishers)

    def _count(self, now_s: float) -> None:
        """Compute the message rate over whole seconds, so that its display does not flicker."""
        if self._since is None:
            self._since = now_s, self._states.received
        before_s, before = self._since
        if now_s - before_s >= 1.0:
            self._rate_hz = (self._states.received - before) / (now_s - before_s)
            self._since = now_s, self._states.received


def _missing(topic: str, for_s: float | None, publishers: int) -> str:
    """
    Format the status of a topic on which no messages arrive.

    Parameters
    ----------
    topic
        The name of the topic.
    for_s
        The time without messages, in s; None if none has arrived yet.
    publishers
        The number of its publishers.

    """
    what = 'Nothing received yet' if for_s is None else f'Nothing for {for_s:.0f} s'
    if not publishers:
        return f'{topic}: {what}; it has no publisher.'
    who = 'its publisher is' if publishers == 1 else f'its {publishers} publishers are'
    return f'{topic}: {what}; {who} silent.'
