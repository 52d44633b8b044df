# SPDX-License-Identifier: Apache-2.0
"""Fixtures: a page that nobody looks at, and a node in a domain of its own."""

from collections.abc import Callable, Iterator
from pathlib import Path
import time
from typing import Any

from domain_coordinator import domain_id
import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rviz_common.config import Configuration
from rviz_common.page import NO_TOKEN, Page, PageSettings
from rviz_common.visualizer import Visualizer

FILES = Path(__file__).parent / 'files'
PATIENCE_S = 100.0


@pytest.fixture(scope='session')
def page() -> Iterator[Page]:
    """Serve a page."""
    with Page('test', PageSettings(token=NO_TOKEN)) as page:
        yield page


@pytest.fixture
def node() -> Iterator[Node]:
    """Return a node in a domain of its own."""
    with domain_id() as domain:
        context = rclpy.Context()
        rclpy.init(context=context, domain_id=domain)
        try:
            node = Node('rviz2', context=context)
            yield node
            node.destroy_node()
        finally:
            context.try_shutdown()


@pytest.fixture
def spin_until(node: Node) -> Iterator[Callable[..., None]]:
    """Return what lets the node work until something is so."""
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)

    def spin_until(is_so: Callable[[], Any], what: str = 'it') -> None:
        end_s = time.monotonic() + PATIENCE_S
        while not is_so():
            assert time.monotonic() < end_s, f'{what} has not come true'
            executor.spin_once(timeout_sec=0.05)

    yield spin_until
    executor.shutdown()


@pytest.fixture
def show(node: Node, page: Page) -> Iterator[Callable[..., Visualizer]]:
    """Return what shows the text of a file in the page."""
    shown: list[Visualizer] = []

    def show(text: str, path: str = '') -> Visualizer:
        configuration = Configuration.parse(text, path or 'test.rviz')
        shown.append(Visualizer(node, page, configuration, path))
        return shown[-1]

    yield show
    for visualizer in shown:
        visualizer.close()


@pytest.fixture(params=['default', 'navigation', 'manipulation'])
def file(request: pytest.FixtureRequest) -> Path:
    """Return a file in the form in which RViz writes it."""
    return FILES / f'{request.param}.rviz'
