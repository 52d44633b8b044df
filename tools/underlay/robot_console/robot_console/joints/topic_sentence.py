# SPDX-License-Identifier: Apache-2.0
"""Status messages of the joint topics."""

from __future__ import annotations

from robot_console.joints.joint_state import JointStates

__all__ = ['TopicWatch', 'missing']

LATE_S = 1.0


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
            return f'{self.topic}: {count} joints, {self._rate_hz:.0f} messages a second'
        last_s = self._states.last_s
        return missing(self.topic, None if last_s is None else now_s - last_s, publishers)

    def _count(self, now_s: float) -> None:
        """Compute the message rate over whole seconds, so that its display does not flicker."""
        if self._since is None:
            self._since = now_s, self._states.received
        before_s, before = self._since
        if now_s - before_s >= 1.0:
            self._rate_hz = (self._states.received - before) / (now_s - before_s)
            self._since = now_s, self._states.received


def missing(topic: str, for_s: float | None, publishers: int) -> str:
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
    what = 'Nothing has come yet' if for_s is None else f'Nothing for {for_s:.0f} s'
    if not publishers:
        return f'{topic}: {what}; nobody publishes it.'
    who = 'its publisher is' if publishers == 1 else f'its {publishers} publishers are'
    return f'{topic}: {what}; {who} silent.'
