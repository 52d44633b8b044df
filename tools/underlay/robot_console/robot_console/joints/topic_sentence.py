# SPDX-License-Identifier: Apache-2.0
"""What there is to say about a topic that messages should come from."""

from __future__ import annotations

from robot_console.joints.joint_state import JointStates

__all__ = ['TopicWatch', 'missing']

LATE_S = 1.0


class TopicWatch:
    """
    The message rate of a joint topic in a sentence, or why nothing comes.

    Parameters
    ----------
    topic
        The fully qualified name of the topic.
    states
        What its messages are stored in, which counts them.

    """

    def __init__(self, topic: str, states: JointStates) -> None:
        self.topic = topic
        self._states = states
        self._since: tuple[float, int] | None = None
        self._rate_hz = 0.0

    def is_late(self, now_s: float) -> bool:
        """
        Check whether no message has come for a second.

        Parameters
        ----------
        now_s
            The time of `time.time`.

        """
        last_s = self._states.last_s
        return last_s is None or now_s - last_s >= LATE_S

    def sentence(self, now_s: float, publishers: int) -> str:
        """
        Describe the topic in a sentence: joints and messages a second, or since when it is silent.

        Parameters
        ----------
        now_s
            The time of `time.time`.
        publishers
            How many publishers the topic has; used only if it is silent.

        """
        self._count(now_s)
        if not self.is_late(now_s):
            count = len(self._states.states)
            return f'{self.topic}: {count} joints, {self._rate_hz:.0f} messages a second'
        last_s = self._states.last_s
        return missing(self.topic, None if last_s is None else now_s - last_s, publishers)

    def _count(self, now_s: float) -> None:
        """Count messages over seconds that are whole, so that the number rests."""
        if self._since is None:
            self._since = now_s, self._states.received
        before_s, before = self._since
        if now_s - before_s >= 1.0:
            self._rate_hz = (self._states.received - before) / (now_s - before_s)
            self._since = now_s, self._states.received


def missing(topic: str, for_s: float | None, publishers: int) -> str:
    """
    Describe in a sentence a topic on which no messages come.

    Parameters
    ----------
    topic
        The name of the topic.
    for_s
        For how long it has been silent, in s; None if nothing has come yet.
    publishers
        How many publishers it has.

    """
    what = 'Nothing has come yet' if for_s is None else f'Nothing for {for_s:.0f} s'
    if not publishers:
        return f'{topic}: {what}; nobody publishes it.'
    who = 'its publisher is' if publishers == 1 else f'its {publishers} publishers are'
    return f'{topic}: {what}; {who} silent.'
