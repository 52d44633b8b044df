# SPDX-License-Identifier: Apache-2.0
"""
Access from the thread of the server to the thread of the node.

The server runs on asyncio; everything that concerns ROS runs in the thread of the node, one call
after another, and results are passed to the event loop of the server.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
import time
from typing import Any

from humanoid_common.errors import UserError
from rclpy.node import Node
from robot_mcp.deadlines import in_time

__all__ = ['NodeThread', 'RobotError', 'in_loop']

_ANSWER_S = 5.0
"""Time limit for anything that should be available immediately."""
_DISCOVERY_S = 4.0
"""How long after its start the node may not have discovered others yet."""
_SETTLED_S = 1.5


class RobotError(UserError):
    """The robot cannot do or show something now; the message states why."""


class NodeThread:
    """
    Caller of functions in the thread of a node. Coroutines are for the thread of the server.

    Parameters
    ----------
    node
        The node.

    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._begin_s = time.monotonic()

    async def do(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """
        Call a function in the thread of the node, and return its result.

        Parameters
        ----------
        function, *arguments
            The function and its arguments; exceptions are passed on.

        Raises
        ------
        RobotError
            The node is not running, or has not finished the call within 5 s.

        """
        loop = asyncio.get_running_loop()
        answer: asyncio.Future[Any] = loop.create_future()

        def settle(error: Exception | None, value: Any) -> None:
            if error is not None and not answer.done():
                answer.set_exception(error)
            else:
                _settle(answer, value)

        def call() -> None:
            try:
                value = function(*arguments)
            except Exception as error:  # passed on to the caller
                in_loop(loop, settle, error, None)
            else:
                in_loop(loop, settle, None, value)

        deadline_s = time.monotonic() + _ANSWER_S
        while self._node.executor is None:
            if time.monotonic() > deadline_s:
                raise RobotError('The node of this server is not running.')
            await asyncio.sleep(0.02)
        self._node.executor.create_task(call)
        try:
            return await in_time(answer, _ANSWER_S)
        except asyncio.TimeoutError:
            raise RobotError('The node of this server is too busy to answer.') from None

    async def found(self, condition: Callable[[], bool]) -> bool:
        """
        Check a condition; within 4 s of the start, wait until it holds.

        Parameters
        ----------
        condition
            Called in the thread of the node; for example, whether a server is available.

        Returns
        -------
        bool
            Whether it holds.

        Raises
        ------
        RobotError
            As for `do`.

        """
        while not await self.do(condition):
            if time.monotonic() > self._begin_s + _DISCOVERY_S:
                return False
            await asyncio.sleep(0.1)
        return True

    async def settle(self) -> None:
        """Wait until discovery can be complete; only shortly after the start."""
        await asyncio.sleep(max(0.0, self._begin_s + _SETTLED_S - time.monotonic()))

    async def newest(self, kind: Any, topic: str, profile: Any, missing: str) -> Any:
        """
        Subscribe to a topic, and wait for one message.

        Parameters
        ----------
        kind, topic, profile
            The message type, the name of the topic, and the QoS profile.
        missing
            The error message if the topic has no publisher.

        Raises
        ------
        RobotError
            No message arrives.

        """
        name = self._node.resolve_topic_name(topic)
        if not await self.found(lambda: self._node.count_publishers(name) > 0):
            raise RobotError(missing)
        loop = asyncio.get_running_loop()
        came: asyncio.Future[Any] = loop.create_future()

        def take(message: Any) -> None:
            in_loop(loop, _settle, came, message)

        subscription = await self.do(
            lambda: self._node.create_subscription(kind, topic, take, profile)
        )
        try:
            return await in_time(came, _ANSWER_S)
        except asyncio.TimeoutError:
            raise RobotError(f"No message received on '{name}'.") from None
        finally:
            executor = self._node.executor
            if executor is not None:
                executor.create_task(self._node.destroy_subscription, subscription)

    async def ask(self, client: Any, request: Any, who: str, timeout_s: float = _ANSWER_S) -> Any:
        """
        Call a service, and wait for its response.

        Parameters
        ----------
        client, request
            A client of the service, and the request.
        who
            The name of the service in the error message.
        timeout_s
            The time limit for the response.

        Raises
        ------
        RobotError
            The service does not respond in time.

        """
        loop = asyncio.get_running_loop()
        came: asyncio.Future[Any] = loop.create_future()

        def send() -> None:
            sent = client.call_async(request)
            sent.add_done_callback(lambda done: in_loop(loop, _settle, came, done.result()))

        await self.do(send)
        try:
            return await in_time(came, timeout_s)
        except asyncio.TimeoutError:
            raise RobotError(f'{who} does not answer.') from None


def _settle(future: asyncio.Future[Any], value: Any) -> None:
    """Set the result of a future, unless it is already done."""
    if not future.done():
        future.set_result(value)


def in_loop(loop: asyncio.AbstractEventLoop, function: Callable[..., Any], *told: Any) -> None:
    """
    Call a function in the thread of an event loop, which may be closed.

    Parameters
    ----------
    loop, function, told
        The loop, the function, and its arguments.

    """
    try:
        loop.call_soon_threadsafe(function, *told)
    except RuntimeError:  # the loop is closed: no one waits any more
        return
