# SPDX-License-Identifier: Apache-2.0
"""A page without visitors, transforms without a network, and a node that only takes notes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
import time
from typing import Any

from geometry_msgs.msg import TransformStamped
import pytest
from rviz_common.context import Context
from rviz_common.display import Display
from rviz_common.frames import Frames
from rviz_common.inputs import WorkQueue
from rviz_common.page import NO_TOKEN, Page, PageSettings
from std_msgs.msg import String
from tf2_ros import Buffer

__all__ = ['Stage', 'page', 'stage']

TIMEOUT_S = 100.0


class NotingNode:
    """Remembers who subscribes; `say` hands a message to them."""

    def __init__(self) -> None:
        self.subscriptions: list[tuple[str, Any, Any]] = []

    def create_subscription(
        self, kind: Any, topic: str, callback: Any, qos: Any, **options: Any
    ) -> Any:
        if ' ' in topic:
            raise ValueError('no topic has a space in its name')
        self.subscriptions.append((topic, callback, qos))
        return self.subscriptions[-1]

    def destroy_subscription(self, subscription: Any) -> None:
        self.subscriptions.remove(subscription)

    def resolve_topic_name(self, topic: str) -> str:
        return topic

    def get_publishers_info_by_topic(self, topic: str) -> list[Any]:
        return []

    def say(self, topic: str, message: Any) -> None:
        for name, callback, _ in list(self.subscriptions):
            if name == topic:
                callback(message)


class Stage:
    """What a display is shown on."""

    def __init__(self, page: Page, fixed_frame: str = 'map') -> None:
        self.server = page.viser
        self.node = NotingNode()
        self.buffer = Buffer()
        self.frames = Frames(self.buffer, fixed_frame)
        self.context = Context(self.node, page, self.frames, WorkQueue())
        self.displays: list[Display] = []
        self._stamp = 0

    def show(self, kind: type[Display], given: Mapping[str, Any] | None = None) -> Any:
        """Start a display with what a file gives."""
        display = kind(self.context, f'/display_{len(self.displays)}', given)
        self.displays.append(display)
        display.start()
        return display

    def describe(self, urdf: str, topic: str = '/robot_description') -> None:
        """Publish a description."""
        self.node.say(topic, String(data=urdf))

    def move(
        self,
        parent: str,
        child: str,
        x: float = 0.0,
        wxyz: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0),
        is_static: bool = False,
    ) -> None:
        """Publish a transform, a second after the one before."""
        self._stamp += 1
        message = TransformStamped(child_frame_id=child)
        message.header.frame_id = parent
        message.header.stamp.sec = self._stamp
        message.transform.translation.x = x
        turn = message.transform.rotation
        turn.w, turn.x, turn.y, turn.z = wxyz
        take = self.buffer.set_transform_static if is_static else self.buffer.set_transform
        take(message, 'test')

    def node_at(self, path: str) -> Any:
        """Return a node of the scene, or None."""
        return self.server.scene._handle_from_node_name.get(path)

    def paths(self) -> list[str]:
        """Return the paths of all nodes of displays."""
        return [path for path in self.server.scene._handle_from_node_name if 'display' in path]

    def work_until(self, done: Any) -> None:
        """Do what other threads post until something is so."""
        end_s = time.monotonic() + TIMEOUT_S
        while not done():
            assert time.monotonic() < end_s, 'it did not happen'
            self.context.queue.run()
            time.sleep(0.01)


@pytest.fixture(scope='session')
def page() -> Iterator[Page]:
    """Serve a page for all tests."""
    with Page('test', PageSettings(token=NO_TOKEN)) as page:
        yield page


@pytest.fixture
def stage(page: Page) -> Iterator[Stage]:
    """Return an empty stage."""
    stage = Stage(page)
    yield stage
    for display in stage.displays:
        display.stop()
    assert stage.paths() == []
    assert stage.node.subscriptions == []


def sentence(display: Display, subject: str) -> str:
    """Return what a display says about a subject, or ''."""
    return next((said for about, _, said in display.status.items() if about == subject), '')
