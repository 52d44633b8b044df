# SPDX-License-Identifier: Apache-2.0
"""A node for the duration of one command."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
import os
import signal
import time
from types import FrameType, TracebackType
from typing import Any, TYPE_CHECKING

from ros2cli.arguments import add_node_arguments as add_arguments
from ros2cli.deferral import import_rclpy
from ros2cli.graph import DEFAULT_SPIN_TIME_S
from ros2cli.node import NODE_NAME_PREFIX

import_rclpy()
import rclpy  # noqa: E402, I100
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor  # noqa: E402
from rclpy.parameter import Parameter  # noqa: E402
from rclpy.signals import SignalHandlerOptions  # noqa: E402

if TYPE_CHECKING:
    from ros2cli.graph.graph import Graph
    from ros2cli.graph.watch import GraphWatch

__all__ = ['DirectNode', 'add_arguments']

_LATE_S = 0.5
_LOOK_S = 0.005


class DirectNode:
    """
    An rclpy node that exists inside a `with` statement; it forwards the node's attributes.

    rclpy is initialized on entry and shut down on exit.

    Parameters
    ----------
    args : argparse.Namespace | None
        The options of `add_node_arguments` and `add_ros_args_argument`; None or missing options
        mean the defaults.
    node_name
        The name of the node; by default a hidden one with the process ID.
    survives_interrupt
        Whether the node outlives Ctrl-C, so that it can still send final messages.

    Attributes
    ----------
    node, executor
        The rclpy node, and the executor that spins it, inside the `with` statement.

    """

    def __init__(
        self,
        args: argparse.Namespace | None,
        *,
        node_name: str | None = None,
        survives_interrupt: bool = False,
    ) -> None:
        self._spin_time_s: float = getattr(args, 'spin_time', DEFAULT_SPIN_TIME_S)
        self._watch: GraphWatch | None = None
        self._use_sim_time: bool = getattr(args, 'use_sim_time', False)
        ros_args: list[str] = getattr(args, 'ros_args', [])
        self._words = ['--ros-args', *ros_args] if ros_args else []
        self._node_name = node_name or f'{NODE_NAME_PREFIX}_{os.getpid()}'
        self._signals = (
            SignalHandlerOptions.SIGTERM if survives_interrupt else SignalHandlerOptions.ALL
        )

    def __enter__(self) -> DirectNode:
        """Initialize rclpy and create the node; discovery is not waited for."""
        self._is_terminated = False
        self._before = signal.signal(signal.SIGTERM, self._note_sigterm)
        rclpy.init(args=self._words, signal_handler_options=self._signals)
        self.node = rclpy.create_node(
            self._node_name,
            start_parameter_services=False,
            enable_rosout=False,
            parameter_overrides=[
                Parameter('use_sim_time', value=self._use_sim_time),
                Parameter('start_type_description_service', value=False),
            ],
        )
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)
        return self

    @property
    def watch(self) -> GraphWatch:
        """Return the graph watch, which is faster than the discovery of rclpy."""
        if self._watch is None:
            from ros2cli.graph.watch import GraphWatch

            self._watch = GraphWatch(self._spin_time_s, _check_rclpy)
        return self._watch

    @property
    def graph(self) -> Graph:
        """Return the complete graph, without this node."""
        return self.watch.settled()

    def spin_once(self, timeout_s: float) -> None:
        """
        Execute a callback that is ready, or wait for one.

        Parameters
        ----------
        timeout_s
            The timeout in s.

        """
        self.executor.spin_once(timeout_sec=timeout_s)

    def __getattr__(self, name: str) -> Any:
        """Return an attribute of the rclpy node."""
        if name in ('node', 'executor'):
            raise AttributeError(f'the node exists only inside a with statement: {name!r}')
        return getattr(self.node, name)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Shut the node down; suppress an error caused by SIGTERM having shut rclpy down."""
        is_shut_down = not rclpy.ok() and not isinstance(error, KeyboardInterrupt)
        with interrupts_deferred() as interrupts:
            if self._watch is not None:
                self._watch.close()
            self.executor.shutdown()
            self._destroy_waitables()
            self.node.destroy_node()
            rclpy.try_shutdown()
            # The signal that has shut rclpy down may not have reached Python yet: which one is it?
            end_s = time.monotonic() + _LATE_S
            while is_shut_down and not (interrupts or self._is_terminated):
                if time.monotonic() > end_s:
                    break
                time.sleep(_LOOK_S)
            signal.signal(signal.SIGTERM, self._before)
        if is_shut_down:
            raise ExternalShutdownException from None

    def _note_sigterm(self, number: int, _: FrameType | None) -> None:
        self._is_terminated = True

    def _destroy_waitables(self) -> None:
        """
        Destroy what `Node.destroy_node` leaves to the garbage collector, such as action clients.

        Each keeps the participant alive, and the process exits without garbage collection: others
        would wait 20 s for answers from a participant that no longer exists.
        """
        for each in list(self.node.waitables):
            if destroy := getattr(each, 'destroy', None):
                destroy()


def _check_rclpy() -> None:
    """Raise if rclpy is shut down, to end a wait outside of ROS: SIGTERM only shuts rclpy down."""
    if not rclpy.ok():
        raise ExternalShutdownException


@contextmanager
def interrupts_deferred() -> Iterator[list[int]]:
    """
    Raise KeyboardInterrupt only at the end of the block.

    This includes an earlier SIGINT that rclpy has received but Python has not handled yet.

    Yields
    ------
    list of int
        The number of SIGINT, as often as it was received so far.

    """
    received: list[int] = []

    def remember(number: int, _: FrameType | None) -> None:
        received.append(number)

    try:
        previous = signal.signal(signal.SIGINT, remember)
    except KeyboardInterrupt:
        remember(signal.SIGINT, None)
        previous = signal.signal(signal.SIGINT, remember)
    try:
        yield received
    finally:
        signal.signal(signal.SIGINT, previous)
    if received:
        raise KeyboardInterrupt
