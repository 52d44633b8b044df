# SPDX-License-Identifier: Apache-2.0
"""Fixtures: a domain, and an executor for the nodes of the demos."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable, Iterator
from pathlib import Path
import sys
import time
from types import ModuleType
from typing import Any

import pytest
import rclpy
from rclpy.node import Node
from tf2_ros.executing import make_executor

sys.path.insert(0, str(Path(__file__).parents[2] / 'robot_state_publisher/test'))

from publisher_fixtures import domain  # noqa: E402
from publisher_probe import TIMEOUT_S  # noqa: E402

__all__ = ['domain']


class Stage:
    """Runs the nodes of demos in this process."""

    def __init__(self, domain: int, capture: pytest.CaptureFixture[str]) -> None:
        """Initialise ROS."""
        rclpy.init(domain_id=domain)
        self.executor = make_executor()
        self._nodes: list[Node] = []
        self._capture = capture
        self._log = ''

    @property
    def log(self) -> str:
        """Return what the nodes have logged so far."""
        self._log += self._capture.readouterr().err
        return self._log

    def start(self, demo: ModuleType, command: str) -> tuple[Namespace, Any, Any]:
        """Start the nodes of a demo; return its options, the talker and the listener."""
        options = demo.make_parser().parse_args(command.split())
        nodes = talker, listener = demo.make_nodes(options)
        self.add(*nodes)
        return options, talker, listener

    def add(self, *nodes: Node) -> None:
        """Run nodes."""
        for node in nodes:
            self._nodes.append(node)
            self.executor.add_node(node)

    def until(self, is_so: Callable[[], Any], message: str) -> None:
        """Work until something is so, or fail with the message and the log."""
        end_s = time.monotonic() + TIMEOUT_S
        while not is_so():
            assert time.monotonic() < end_s, f'{message} in:\n{self.log}'
            self.executor.spin_once(timeout_sec=0.05)

    def until_logged(self, *texts: str) -> None:
        """Work until texts are in the log."""
        self.until(lambda: all(text in self.log for text in texts), f'{texts} are not')

    def close(self) -> None:
        """Destroy the nodes."""
        self.executor.shutdown()
        for node in self._nodes:
            node.destroy_node()
        rclpy.shutdown()


@pytest.fixture
def stage(domain: int, capfd: pytest.CaptureFixture[str]) -> Iterator[Stage]:
    """Return what runs demos in the domain of the test."""
    stage = Stage(domain, capfd)
    yield stage
    stage.close()
