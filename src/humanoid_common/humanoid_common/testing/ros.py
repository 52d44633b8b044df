# SPDX-License-Identifier: Apache-2.0
"""Sandbox for nodes in this process, in a ROS domain of their own."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import cache
import gc
from itertools import count
import os
from typing import Any, TypeVar

from domain_coordinator import domain_id
from humanoid_common.executing import destroy, make_executor
from humanoid_common.testing.waiting import wait_until
import rclpy
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter

NodeT = TypeVar('NodeT', bound=Node)
SLICE_S = 0.01
"""Maximum wait for an event between two evaluations of a condition."""


class RosSandbox:
    """
    Separate context and executor, for nodes that discover only each other.

    Parameters
    ----------
    domain
        The ROS domain ID of the nodes.

    Attributes
    ----------
    environment
        Environment variables with which a program joins the domain, on this machine.

    """

    def __init__(self, domain: int) -> None:
        self.environment = {
            'ROS_DOMAIN_ID': str(domain),
            'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
        }
        self._context = Context()
        rclpy.init(args=[], context=self._context, domain_id=domain)
        self._executor = make_executor(self._context)
        self._nodes: list[Node] = []
        self._observers = count(1)

    def start(
        self,
        factory: Callable[..., NodeT],
        parameters: Mapping[str, Any] = {},
        **options: Any,
    ) -> NodeT:
        """
        Start a node with parameter values, as if they came from a parameter file.

        Parameters
        ----------
        factory
            Creates the node; it accepts the keyword arguments of `rclpy.node.Node`.
        parameters : Mapping[str, Any]
            Values by parameter name.
        **options
            Further arguments for the factory.

        """
        overrides = [Parameter(name, value=value) for name, value in parameters.items()]
        node = factory(context=self._context, parameter_overrides=overrides, **options)
        self._nodes.append(node)
        self._executor.add_node(node)
        return node

    def end(self, node: Node) -> None:
        """
        Destroy a node that was started here, as if its process were killed.

        Parameters
        ----------
        node
            What `start` or `observer` returned.

        """
        self._nodes.remove(node)
        self._executor.remove_node(node)
        self._handle()  # what a response has triggered would meet a node without its entities
        destroy(node)

    def observer(self) -> Node:
        """Start a plain node with a unique name, to observe the others."""
        name = f'observer_{next(self._observers)}'
        return self.start(lambda **options: Node(name, **options))

    def wait_until(
        self,
        predicate: Callable[[], bool],
        timeout_s: float = 60.0,
        what: str | Callable[[], str] = 'the condition',
    ) -> None:
        """
        Spin the nodes until a condition holds; the message of a failure lists the topics.

        All pending events are handled between two evaluations: with only one event each, a
        predicate that publishes would fill the queue faster than it is emptied.

        Parameters
        ----------
        predicate
            The condition.
        timeout_s
            Real time to wait.
        what
            Description of the condition, for the message of a failure, or what makes it then.

        Raises
        ------
        WaitedInVainError
            The condition did not come true in time.

        """
        wait_until(
            predicate,
            timeout_s,
            lambda: f'{what if isinstance(what, str) else what()}; {self._graph()}',
            self._handle,
        )

    def _handle(self) -> None:
        """Wait briefly for an event, and handle it with all pending ones."""
        self._executor.spin_once(timeout_sec=SLICE_S)
        # A timer that is always due keeps a spin from ending by its timeout; a task ends it.
        last = self._executor.create_task(_nothing)
        self._executor.spin_until_future_complete(last, timeout_sec=SLICE_S)

    def close(self) -> None:
        """Destroy the nodes and shut down the context."""
        self._executor.shutdown()
        for node in self._nodes:
            destroy(node)
        self._context.try_shutdown()
        # A node whose construction failed still has its participant, which would be visible to
        # the next users of the domain.
        gc.collect()

    def _graph(self) -> str:
        """Describe the topics that the nodes see."""
        names = sorted(
            {
                name
                for node in self._nodes
                for name, _ in node.get_topic_names_and_types(no_demangle=False)
            }
        )
        return f'topics: {", ".join(names)}'


def _nothing() -> None:
    """Mark the end of all tasks that were pending before."""


@cache
def _freeze_what_is_loaded() -> None:
    """Spare each sandbox the search for garbage in modules, which stay until the end."""
    gc.collect()
    gc.freeze()


@contextmanager
def ros_sandbox() -> Iterator[RosSandbox]:
    """
    Open a sandbox in a domain that no one else uses, confined to this machine.

    The environment is set for programs that are started within the block, and restored after it.
    """
    _freeze_what_is_loaded()
    with domain_id() as domain:
        names = ('ROS_DOMAIN_ID', 'ROS_AUTOMATIC_DISCOVERY_RANGE', 'ROS_DISCOVERY_SERVER')
        saved = {name: os.environ.pop(name, None) for name in names}
        os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
        os.environ['ROS_DOMAIN_ID'] = str(domain)
        sandbox = RosSandbox(domain)
        try:
            yield sandbox
        finally:
            sandbox.close()
            _restore(saved)


def _restore(saved: Mapping[str, str | None]) -> None:
    """Restore the environment variables."""
    for name, value in saved.items():
        if value is None:
            os.environ.pop(name, None)
        else:
            os.environ[name] = value
