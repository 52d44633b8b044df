# SPDX-License-Identifier: Apache-2.0
"""What there is to say about a topic that messages should come from."""

from __future__ import annotations

from robot_console.joints.joint_state import JointStates

__all__ = ['TopicWatch', 'missing']

LATE_S = 1.0


class TopicWatch:
    """Counts the messages of a topic, and says how many come, or why none do."""

    def __init__(self, topic: str, states: JointStates) -> None:
        """Take the full name of a topic, and what is said on it."""
        self.topic = topic
        self._states = states
        self._since: tuple[float, int] | None = None
        self._rate_hz = 0.0

    def is_late(self, now_s: float) -> bool:
        """Tell if no message has come for a second."""
        last_s = self._states.last_s
        return last_s is None or now_s - last_s >= LATE_S

    def sentence(self, now_s: float, publishers: int) -> str:
        """Return what there is to say."""
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
    """Say since when nothing comes, and who could be asked."""
    what = 'Nothing has come yet' if for_s is None else f'Nothing for {for_s:.0f} s'
    if not publishers:
        return f'{topic}: {what}; nobody publishes it.'
    who = 'its publisher is' if publishers == 1 else f'its {publishers} publishers are'
    return f'{topic}: {what}; {who} silent.'
