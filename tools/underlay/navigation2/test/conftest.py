# SPDX-License-Identifier: Apache-2.0
"""Fixtures: nodes of a test with an executor and a ROS domain of their own."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import gc
import math
import os
import time
from typing import Any

from domain_coordinator import domain_id
import pytest
import rclpy
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from tf2_ros.executing import make_executor

_REPEAT_S = 2.0


class Ros:
    """A context, and an executor that runs the nodes of a test."""

    def __init__(self, context: Context) -> None:
        self.context = context
        self.executor = make_executor(context)
        self.nodes: list[Node] = []

    def add(self, node: Node) -> Any:
        """Run a node and its companions until the test ends; return it."""
        self.nodes.append(node)
        for each in [node, *getattr(node, 'companions', ())]:
            if each.executor is None:
                self.executor.add_node(each)
        return node

    def make(self, kind: Callable[..., Node], parameters: dict[str, Any] | None = None, **options):
        """Make a node with parameters, and run it."""
        overrides = [Parameter(name, value=value) for name, value in (parameters or {}).items()]
        return self.add(kind(context=self.context, parameter_overrides=overrides, **options))

    def node(self, name: str = 'tester', **options: Any) -> Node:
        """Make a plain node, and run it."""
        return self.add(Node(name, context=self.context, **options))

    def wait_until(
        self, predicate: Callable[[], Any], timeout_s: float = 20.0, what: str = 'it'
    ) -> Any:
        """Run the nodes until something is true; return what the predicate returned."""
        end_s = time.monotonic() + timeout_s
        while not (found := predicate()):
            if time.monotonic() > end_s:
                pytest.fail(f'Waited {timeout_s:g} s for {what}. {self._graph()}')
            self.executor.spin_once(timeout_sec=0.02)
        return found

    def call(
        self,
        kind: Any,
        name: str,
        request: Any = None,
        timeout_s: float = 20.0,
        repeat_s: float = math.inf,
    ) -> Any:
        """Call a service, again after each `repeat_s` without a response; return the response."""
        node = next((each for each in self.nodes if each.get_name() == 'tester'), None)
        node = node or self.node()
        client = node.create_client(kind, name)
        self.wait_until(client.service_is_ready, timeout_s, f"the service '{name}'")
        request = kind.Request() if request is None else request
        futures = [client.call_async(request)]
        start_s = time.monotonic()

        def response() -> Any:
            if time.monotonic() - start_s > len(futures) * repeat_s:
                futures.append(client.call_async(request))
            return next((each for each in futures if each.done()), None)

        found = self.wait_until(response, timeout_s, f"an answer of '{name}'")
        node.destroy_client(client)
        return found.result()

    def ask(self, kind: Any, name: str, request: Any = None) -> Any:
        """
        Call an idempotent service of another process; return the response.

        A server drops its response to a client that it has not discovered yet, so that the
        request is repeated.
        """
        return self.call(kind, name, request, repeat_s=_REPEAT_S)

    def spin(self, duration_s: float) -> None:
        """Run the nodes for a while, to see that something does not happen."""
        end_s = time.monotonic() + duration_s
        while time.monotonic() < end_s:
            self.executor.spin_once(timeout_sec=0.01)

    def close(self) -> None:
        """Destroy the nodes, the newest first."""
        for node in reversed(self.nodes):
            node.destroy_node()
            for action in list(node.waitables):  # clients of actions would stay in the graph
                if hasattr(action, 'destroy'):
                    action.destroy()
        self.executor.shutdown()

    def _graph(self) -> str:
        if not self.nodes:
            return 'There are no nodes.'
        names = sorted(
            '/'.join(each[::-1]) for each in self.nodes[0].get_node_names_and_namespaces()
        )
        topics = sorted(name for name, _ in self.nodes[0].get_topic_names_and_types())
        return f'Nodes: {", ".join(names)}. Topics: {", ".join(topics)}.'


@pytest.fixture(scope='session')
def domain() -> Iterator[int]:
    """Reserve a domain, unless it was reserved for all tests of this process."""
    if 'ROS_DOMAIN_ID' in os.environ:
        yield int(os.environ['ROS_DOMAIN_ID'])
        return
    with domain_id() as reserved:
        yield reserved


@pytest.fixture(scope='session')
def ros_class() -> type[Ros]:
    """Return the class, for fixtures of whole files."""
    return Ros


@pytest.fixture
def ros(domain: int, monkeypatch: pytest.MonkeyPatch) -> Iterator[Ros]:
    """Run nodes that nobody outside of this host hears."""
    monkeypatch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    context = Context()
    rclpy.init(args=[], context=context, domain_id=domain)
    made = Ros(context)
    yield made
    made.close()
    context.try_shutdown()
    del made, context
    gc.collect()  # rclpy leaves sockets of what has ended to this, and a process has not so many
