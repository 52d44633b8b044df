# SPDX-License-Identifier: Apache-2.0
"""Run a ROS node alongside the event loop of a launch."""

from __future__ import annotations

import asyncio
import atexit
from collections.abc import Coroutine
import os
import threading
from typing import Any, Optional, TYPE_CHECKING

from launch.logging import get_logger
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

_CANCEL_AGAIN_S = 0.2
_ENDING_S = 10.0


class ROSAdapter:
    """
    The ROS node of a launch, with its own ROS context, spun by its own thread.

    Parameters
    ----------
    use_sim_time
        Whether the clock of the node follows `/clock` from the start.
    loop
        The event loop that runs the launch. Without one no tasks can be started.

    """

    def __init__(
        self,
        *,
        use_sim_time: bool = False,
        loop: Optional[asyncio.AbstractEventLoop] = None,
    ) -> None:
        self._loop = loop
        self._tasks: set[asyncio.Task[Any]] = set()
        self._stopping = threading.Event()
        self._ros_context = Context()
        self._ros_context.init(args=[])
        self._ros_node = Node(
            f'launch_ros_{os.getpid()}',
            context=self._ros_context,
            use_global_arguments=False,
            enable_rosout=False,
            start_parameter_services=False,
            parameter_overrides=[_use_sim_time(use_sim_time)],
        )
        self._ros_executor = SingleThreadedExecutor(context=self._ros_context)
        self._ros_executor.add_node(self._ros_node)
        self._ended: Optional[asyncio.Future[None]] = None
        self._thread = threading.Thread(target=self._spin, name='launch_ros', daemon=True)
        self._thread.start()
        atexit.register(self.shutdown)

    @property
    def ros_context(self) -> Context:
        """Return the ROS context."""
        return self._ros_context

    @property
    def ros_node(self) -> Node:
        """Return the node."""
        return self._ros_node

    @property
    def ros_executor(self) -> SingleThreadedExecutor:
        """Return the executor that spins the node."""
        return self._ros_executor

    @property
    def is_running(self) -> bool:
        """Whether the node is running and not shutting down."""
        return not self._stopping.is_set()

    def set_use_sim_time(self, value: bool) -> None:
        """
        Set the parameter `use_sim_time` of the node.

        Parameters
        ----------
        value
            Whether the clock of the node follows `/clock`.

        """
        self._ros_node.set_parameters([_use_sim_time(value)])

    def start_task(self, coroutine: Coroutine[Any, Any, Any]) -> asyncio.Task[Any]:
        """
        Start a coroutine that uses the node; it is canceled before the node is destroyed.

        Parameters
        ----------
        coroutine
            Runs in the event loop of the launch.

        Returns
        -------
        asyncio.Task
            The task that runs it.

        Raises
        ------
        RuntimeError
            The launch is not running, so there is no event loop.

        """
        if self._loop is None:
            coroutine.close()
            raise RuntimeError("the launch's own ROS node can only be used by a running launch")
        task = self._loop.create_task(coroutine)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        return task

    # The executor thread.

    def _spin(self) -> None:
        while not self._stopping.is_set() and self._ros_context.ok():
            try:
                self._ros_executor.spin_once()
            except Exception as error:
                get_logger('launch_ros').error(
                    "a callback of the launch's own ROS node failed: %s: %s",
                    type(error).__name__,
                    error,
                )
        self._take_down()

    def _take_down(self) -> None:
        self._stopping.set()
        self._ros_executor.shutdown()
        self._ros_node.destroy_node()
        self._ros_context.try_shutdown()
        if self._loop is not None and self._ended is not None:
            self._loop.call_soon_threadsafe(self._ended.set_result, None)

    # Shutdown.

    def _stop(self) -> None:
        """Request the thread to leave its loop; a task wakes up the executor."""
        if not self._stopping.is_set():
            self._stopping.set()
            self._ros_executor.create_task(lambda: None)

    def shutdown(self) -> None:
        """Shut the node down and wait for its thread, with a timeout for slow callbacks."""
        self._stop()
        self._thread.join(_ENDING_S)
        atexit.unregister(self.shutdown)

    def end_within(self, context: LaunchContext) -> None:
        """
        Shut the node down without blocking the event loop of the launch.

        Tasks are canceled first. The launch waits for the shutdown of the node before it ends.

        Parameters
        ----------
        context
            The context of the launch that is shutting down.

        """
        if self._loop is None:
            self.shutdown()
        else:
            context.add_completion_future(self._loop.create_task(self._end()))

    async def _end(self) -> None:
        while self._tasks:  # again: a task whose result arrives at that moment is not canceled
            for task in self._tasks:
                task.cancel()
            await asyncio.wait(set(self._tasks), timeout=_CANCEL_AGAIN_S)
            await asyncio.sleep(0)
        if self.is_running:
            self._ended = asyncio.get_running_loop().create_future()
            self._stop()
            await asyncio.wait([self._ended], timeout=_ENDING_S)
        self.shutdown()


def _use_sim_time(value: bool) -> Parameter:
    return Parameter('use_sim_time', Parameter.Type.BOOL, value)
