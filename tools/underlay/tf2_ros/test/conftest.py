# SPDX-License-Identifier: Apache-2.0
"""Fixtures: a domain of one's own, nodes in it, and programs as processes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import os
from pathlib import Path
import subprocess
import sys
from typing import IO

from domain_coordinator import domain_id
import pytest
import rclpy
from rclpy.action import ActionClient, ActionServer
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

sys.path.insert(0, str(Path(__file__).parents[2] / 'tf2_py' / 'test'))
ACTIONS = (ActionClient, ActionServer)
TIMEOUT_S = 100.0


@pytest.fixture(scope='session')
def domain() -> Iterator[int]:
    """Reserve a domain."""
    with domain_id() as domain:
        yield domain


@pytest.fixture
def context(domain: int, monkeypatch: pytest.MonkeyPatch) -> Iterator[Context]:
    """Return a context in the domain."""
    monkeypatch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    context = Context()
    rclpy.init(args=[], context=context, domain_id=domain)
    yield context
    context.try_shutdown()


@pytest.fixture
def make_node(context: Context) -> Iterator[Callable[..., Node]]:
    """
    Return a function that creates a node; all end with the test, for others hear them.

    So do clients and servers of actions, which a node does not destroy itself.
    """
    made: list[Node] = []

    def make(name: str, **options: object) -> Node:
        made.append(Node(name, context=context, **options))
        return made[-1]

    yield make
    for node in made:
        for action in [each for each in node.waitables if isinstance(each, ACTIONS)]:
            action.destroy()
        node.destroy_node()


@pytest.fixture
def spin_until(context: Context) -> Callable[..., None]:
    """Return a function that lets nodes work until something is true."""

    def spin(condition: Callable[[], object], *nodes: Node) -> None:
        import time

        executor = SingleThreadedExecutor(context=context)
        for node in nodes:
            executor.add_node(node)
        end_s = time.monotonic() + TIMEOUT_S
        while not condition():
            assert time.monotonic() < end_s, 'it has not become true'
            executor.spin_once(timeout_sec=0.05)
        for node in nodes:
            executor.remove_node(node)
        executor.shutdown()

    return spin


@pytest.fixture
def start_program(domain: int) -> Iterator[Callable[..., subprocess.Popen[str]]]:
    """Return a function that starts a module as a program; all end with the test."""
    started = []

    def start(
        module: str, *words: str, stdout: int | IO[str] = subprocess.PIPE
    ) -> subprocess.Popen[str]:
        process = subprocess.Popen(
            [sys.executable, '-m', module, *words],
            env={
                **os.environ,
                'ROS_DOMAIN_ID': str(domain),
                'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
            },
            stdout=stdout,
            stderr=subprocess.PIPE,
            text=True,
        )
        started.append(process)
        return process

    yield start
    for process in started:
        if process.poll() is None:
            process.kill()
        process.communicate()
