# SPDX-License-Identifier: Apache-2.0
"""The stage of the displays of robots, with a node that knows who publishes."""

from __future__ import annotations

from collections.abc import Iterator
import time
from typing import Any

import pytest
from rviz_common.page import Page
from stage import NotingNode, page
from stage import Stage as RobotStage

__all__ = ['Stage', 'page', 'stage']


class _Waiting:
    """A subscription whose messages wait."""

    def __init__(self, kind: Any) -> None:
        self.msg_type = kind
        self.messages: list[Any] = []
        self.handle = self

    def __enter__(self) -> None:
        """Begin to take."""

    def __exit__(self, *error: object) -> None:
        """Take no more."""

    def take_message(self, kind: Any, is_raw: bool) -> Any:
        if not self.messages:
            return None
        return self.messages.pop(0), {'received_timestamp': time.time_ns()}


class PublisherNode(NotingNode):
    """A node that takes notes, and tells how many publish."""

    publishers = 0

    def __init__(self) -> None:
        super().__init__()
        self.waiting: list[tuple[_Waiting, Any]] = []

    def create_subscription(
        self, kind: Any, topic: str, callback: Any, qos: Any, **options: Any
    ) -> Any:
        waiting = _Waiting(kind)
        is_polled = 'callback_group' in options
        take = waiting.messages.append if is_polled else callback
        super().create_subscription(kind, topic, take, qos)
        self.waiting.append((waiting, self.subscriptions[-1]))
        return waiting if is_polled else self.subscriptions[-1]

    def destroy_subscription(self, subscription: Any) -> None:
        known = {id(waiting): each for waiting, each in self.waiting}
        super().destroy_subscription(known.get(id(subscription), subscription))

    def resolve_topic_name(self, topic: str) -> str:
        if ' ' in topic:
            raise ValueError('no topic has a space in its name')
        return topic if topic.startswith('/') else f'/{topic}'

    def count_publishers(self, topic: str) -> int:
        return self.publishers


class Stage(RobotStage):
    """What a display is shown on."""

    node: PublisherNode

    def __init__(self, page: Page) -> None:
        super().__init__(page)
        object.__setattr__(self.context, 'node', PublisherNode())
        self.node: Any = self.context.node

    def later(self, monkeypatch: pytest.MonkeyPatch, seconds: float) -> float:
        """Have some time gone by."""
        now_s = time.time() + seconds
        wait_s = time.monotonic() + seconds
        monkeypatch.setattr(time, 'time', lambda: now_s)
        monkeypatch.setattr(time, 'monotonic', lambda: wait_s)
        return now_s


@pytest.fixture
def stage(page: Page) -> Iterator[Stage]:
    """Return an empty stage."""
    stage = Stage(page)
    yield stage
    for display in stage.displays:
        display.stop()
    assert stage.paths() == []
    assert stage.node.subscriptions == []
