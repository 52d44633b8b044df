# SPDX-License-Identifier: Apache-2.0
"""A stage whose node has a clock, and whose page may have visitors."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from rviz_common.context import Context
from rviz_common.display import Display
from rviz_common.page import Page
from stage import NotingNode, sentence, Stage
import viser

__all__ = ['MessageStage', 'all_sentences', 'message_stage', 'near', 'sentence', 'vector']

TOPIC = '/topic'


class ClockedNode(NotingNode):
    """A node whose time passes as the test says."""

    def __init__(self) -> None:
        super().__init__()
        self.now_s = 100.0

    def get_clock(self) -> Any:
        return self

    def now(self) -> Any:
        return self

    @property
    def nanoseconds(self) -> int:
        return round(self.now_s * 1e9)


class VisitedServer:
    """A server that says that somebody has the page open."""

    def __init__(self, server: viser.ViserServer) -> None:
        self._server = server
        self.visitors: dict[int, Any] = {1: None}

    def __getattr__(self, name: str) -> Any:
        return getattr(self._server, name)

    def get_clients(self) -> dict[int, Any]:
        return self.visitors


class MessageStage(Stage):
    """What a display of messages is shown on; its topic is `/topic`."""

    node: Any

    def __init__(self, page: Page) -> None:
        super().__init__(page)
        self.node = ClockedNode()
        self.visited = VisitedServer(page.viser)
        visited_page: Any = SimpleNamespace(viser=self.visited)
        self.context = Context(self.node, visited_page, self.frames, self.context.queue)

    def listen(self, kind: type[Display], given: Mapping[str, Any] | None = None) -> Any:
        """Start a display that listens to the topic."""
        return self.show(kind, {'Topic': {'Value': TOPIC}, **(given or {})})

    def tell(self, display: Display, *messages: Any, frame: str = 'map') -> None:
        """Have messages come, and a frame drawn."""
        for message in messages:
            if hasattr(message, 'header') and not message.header.frame_id:
                message.header.frame_id = frame
            self.node.say(TOPIC, message)
        display.update()

    def at(self, display: Display, path: str) -> Any:
        """Return what a display has drawn at a path below it."""
        found = self.node_at(f'{display.root}/{path}')
        assert found is not None, f'{path} is not among {self.drawn(display)}'
        return found

    def drawn(self, display: Display) -> list[str]:
        """Return the paths of what a display shows, below it, in order."""
        start = f'{display.root}/'
        hidden = [path for path in self.paths() if not self.node_at(path).visible]
        return sorted(
            path.removeprefix(start)
            for path in self.paths()
            if path.startswith(start)
            and not any(f'{path}/'.startswith(f'{above}/') for above in hidden)
        )


@pytest.fixture
def message_stage(page: Page) -> Iterator[MessageStage]:
    """Return an empty stage."""
    stage = MessageStage(page)
    yield stage
    for display in stage.displays:
        display.stop()
    assert stage.paths() == []
    assert stage.node.subscriptions == []


def all_sentences(display: Display) -> str:
    """Return all that a display says."""
    return '\n'.join(said for _, _, said in display.status.items())


def near(value: Any, *expected: float) -> bool:
    """Tell if numbers are as expected."""
    return bool(np.allclose(np.asarray(value, dtype=float), expected, atol=1e-5))


def vector(target: Any, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Any:
    """Set and return a vector or point."""
    target.x, target.y, target.z = x, y, z
    return target
