# SPDX-License-Identifier: Apache-2.0
"""A page that nobody looks at, or somebody seems to, and a node in a domain of its own."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import time
from typing import Any

from domain_coordinator import domain_id
import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rviz_common.context import Context
from rviz_common.frames import Frames
from rviz_common.inputs import WorkQueue
from rviz_common.page import NO_TOKEN, Page, PageSettings
from rviz_common.panel import Panel
from tf2_ros import Buffer

PATIENCE_S = 100.0
Show = Callable[..., Any]


@pytest.fixture(scope='session')
def watched_page() -> Iterator[Page]:
    """Serve a page that somebody seems to look at."""
    with Page('test', PageSettings(token=NO_TOKEN)) as page:
        page.viser.get_clients = lambda: {0: object()}
        yield page


@pytest.fixture
def robot_node() -> Iterator[Node]:
    """Return a node in a domain of its own."""
    with domain_id() as domain:
        context = rclpy.Context()
        rclpy.init(context=context, domain_id=domain)
        try:
            node = Node('console', context=context)
            yield node
            node.destroy_node()
        finally:
            context.try_shutdown()


@pytest.fixture
def show_panel(watched_page: Page, robot_node: Node) -> Iterator[Show]:
    """Return what starts a panel with what a file gives."""
    context = Context(robot_node, watched_page, Frames(Buffer()), WorkQueue())
    panels: list[Panel] = []

    def show(kind: type[Panel], **given: Any) -> Any:
        panels.append(kind(context, given))
        panels[-1].start()
        return panels[-1]

    yield show
    for panel in panels:
        panel.close()
    assert list(robot_node.subscriptions) == []
    watched_page.viser.gui.reset()


@pytest.fixture
def work_until(robot_node: Node) -> Iterator[Callable[..., None]]:
    """Return what lets the node and a panel work until something is so."""
    executor = SingleThreadedExecutor(context=robot_node.context)
    executor.add_node(robot_node)

    def work_until(panel: Panel, is_so: Callable[[], Any], do: Callable[[], Any] = bool) -> None:
        end_s = time.monotonic() + PATIENCE_S
        while not is_so():
            assert time.monotonic() < end_s, 'it has not come true'
            do()
            executor.spin_once(timeout_sec=0.02)
            panel.context.queue.run()
            panel.update()

    yield work_until
    executor.shutdown()
