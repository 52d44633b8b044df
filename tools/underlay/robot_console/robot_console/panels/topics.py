# SPDX-License-Identifier: Apache-2.0
"""Panel with the topics of a robot."""

from __future__ import annotations

from collections.abc import Mapping
import time
from typing import Any, TYPE_CHECKING

from robot_console.live import LivePanel, Viewer
from robot_console.topics.rate_listener import RateListener
from robot_console.topics.topic_graph import ends_of, mismatches, rows_of, types_of
from robot_console.topics.topic_watch import TopicWatch

if TYPE_CHECKING:
    from robot_console.live.channel import Action

__all__ = ['Topics']


class Topics(LivePanel):
    """
    All topics, with types and ends; rates when they are wanted, and the newest message of one.

    Only topics that a viewer has selected are subscribed to.
    """

    CLASS = 'robot_console/Topics'
    PAGE = 'topics'
    PERIOD_S = 0.5

    def settings(self) -> dict[str, Any]:
        """Return the initial settings of the page."""
        namespace = self.values['Namespace']
        return {'below': f'/{namespace}/' if namespace else '/', 'me': self._own_name()}

    def actions(self) -> Mapping[str, Action]:
        """Return the actions that the page may request."""
        return {'choose': self._choose, 'rates': self._want_rates}

    def begin(self) -> None:
        """Initialise the panel; topics are subscribed to only on request."""
        node = self.context.node
        self._rates = RateListener(node, self.context.queue.post)
        self._watches: dict[str, TopicWatch] = {}
        self._want: set[Viewer] = set()
        self._told: Any = None
        self._types: dict[str, list[str]] = {}

    def greet(self, viewer: Viewer) -> None:
        """
        Send the list of topics and known rates to a new viewer.

        Parameters
        ----------
        viewer
            As for `LivePanel.greet`.

        """
        self._types = types_of(self.context.node)
        self._told = self._state()
        viewer.tell(**self._told)

    def refresh(self) -> None:
        """Update the subscriptions, and send changes to the viewers."""
        viewers = self.channel.viewers
        self._want.intersection_update(viewers)
        if viewers:
            self._types = types_of(self.context.node)
        self._measure()
        self._follow({viewer.wish for viewer in viewers if viewer.wish})
        if not viewers:
            return
        state = self._state()
        if state != self._told:
            self._told = state
            self.channel.tell(**state)
        self._tell_details()

    def end(self) -> None:
        """Destroy all subscriptions."""
        self._rates.stop()
        self._follow(set())

    def _state(self) -> dict[str, Any]:
        measured = self._rates.survey.measured
        rates = {topic: _rate_text(*measured[topic]) for topic in self._types if topic in measured}
        return {'rows': rows_of(self.context.node, self._types), 'rates': rates}

    def _measure(self) -> None:
        if self._want:
            self._rates.update(self._types, time.monotonic())
        else:
            self._rates.stop()

    def _follow(self, wanted: set[str]) -> None:
        """Watch only the topics that viewers have selected."""
        types = {topic: self._types[topic] for topic in wanted if topic in self._types}
        for topic, watch in list(self._watches.items()):
            if types.get(topic) != watch.type_names:
                self._watches.pop(topic).close()
        for topic in set(types) - set(self._watches):
            self._watches[topic] = TopicWatch(self.context.node, topic, types[topic])
        for watch in self._watches.values():
            watch.update()

    def _tell_details(self) -> None:
        details = {topic: self._details(topic) for topic in self._watches}
        for viewer in self.channel.viewers:
            if viewer.wish:
                viewer.tell(details=details.get(viewer.wish) or {'topic': viewer.wish})

    def _details(self, topic: str) -> dict[str, Any]:
        watch, node, now_s = self._watches[topic], self.context.node, time.time()
        return {
            'topic': topic,
            'type': ', '.join(self._types.get(topic, ())),
            'rate': watch.window.rate_hz(now_s),
            'bytes': watch.window.bytes_per_s(now_s),
            'age': watch.window.age_s(now_s),
            'count': watch.window.count,
            'size': watch.size,
            'text': watch.text,
            'reasons': [watch.reason] if watch.reason else mismatches(node, topic),
            **ends_of(node, topic),
        }

    def _choose(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        topic = message.get('topic')
        viewer.wish = topic if isinstance(topic, str) else None
        self._pace.hurry()

    def _want_rates(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        if message.get('on') is True:
            self._want.add(viewer)
        else:
            self._want.discard(viewer)
        self._pace.hurry()

    def _own_name(self) -> str:
        name: str = self.context.node.get_fully_qualified_name()
        return name


def _rate_text(rate_hz: float | None, came: bool) -> str:
    """Format a rate with three significant digits."""
    if rate_hz is None:
        return '< 0.5 Hz' if came else 'quiet'
    digits = 0 if rate_hz >= 100 else 1 if rate_hz >= 10 else 2
    return f'{rate_hz:.{digits}f} Hz'
