# SPDX-License-Identifier: Apache-2.0
"""Fixtures: a domain, programs in it, and an executor for the nodes of the examples."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
import sys
import time
from types import ModuleType
from typing import Any

import pytest
import rclpy
from rclpy.executors import Executor
from rclpy.node import Node
from rclpy.task import Future
from tf2_ros.executing import make_executor

sys.path.insert(0, str(Path(__file__).parents[2] / 'robot_state_publisher/test'))

from publisher_fixtures import domain, programs  # noqa: E402
from publisher_probe import TIMEOUT_S  # noqa: E402

__all__ = ['domain', 'programs']


class Stage:
    """Runs the mains of examples in this process, in an executor of the test."""

    def __init__(self, domain: int, capture: pytest.CaptureFixture[str]) -> None:
        """Initialise ROS."""
        rclpy.init(domain_id=domain)
        self.executor: Executor = make_executor()
        self._nodes: list[Node] = []
        self._capture = capture
        self._log = ''

    @property
    def log(self) -> str:
        """Return what the nodes have logged so far."""
        self._log += self._capture.readouterr().err
        return self._log

    def add(self, node: Node) -> None:
        """Run a node."""
        self._nodes.append(node)
        self.executor.add_node(node)

    def main(self, module: ModuleType) -> Future[Any] | None:
        """Run the main of a module here; return what is done with its task, if it has one."""
        ends: list[Future[Any]] = []

        def run_node(make: Callable[[list[str]], Node], _: Any, task: Any = None) -> int:
            node = make([])
            self.add(node)
            if task is not None:
                ends.append(self.executor.create_task(task, node))
            return 0

        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(module, 'run_node', run_node)
            assert module.main() == 0
        return ends[0] if ends else None

    def until(self, is_so: Callable[[], Any], message: str) -> None:
        """Work until something is so, or fail with the message and the log."""
        end_s = time.monotonic() + TIMEOUT_S
        while not is_so():
            assert time.monotonic() < end_s, f'{message} in:\n{self.log}'
            self.executor.spin_once(timeout_sec=0.05)

    def until_logged(self, text: str) -> None:
        """Work until a text is in the log."""
        self.until(lambda: text in self.log, f'{text!r} is not')

    def close(self) -> None:
        """Destroy the nodes."""
        self.executor.shutdown()
        for node in self._nodes:
            node.destroy_node()
        rclpy.shutdown()


@pytest.fixture
def stage(domain: int, capfd: pytest.CaptureFixture[str]) -> Iterator[Stage]:
    """Return what runs examples in the domain of the test."""
    stage = Stage(domain, capfd)
    yield stage
    stage.close()
