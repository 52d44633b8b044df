# SPDX-License-Identifier: Apache-2.0
"""
The thread of the node, as the thread of the server uses it.

The server runs with asyncio; whatever concerns ROS is done in the thread of the node, one piece
after another, and what comes back is handed to the loop of the server.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
import time
from typing import Any

from rclpy.node import Node
from robot_mcp.deadlines import in_time

__all__ = ['NodeThread', 'RobotError', 'in_loop']

_ANSWER_S = 5.0
"""How long anything may take that should be there at once."""
_DISCOVERY_S = 4.0
"""How long after its start the node may not have found others yet."""
_SETTLED_S = 1.5


class RobotError(Exception):
    """The robot cannot do or show something now; the text says why."""


class NodeThread:
    """
    Has functions called in the thread of a node. Coroutines are for the thread of the server.

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
            What is called, and with which arguments; what it raises is passed on.

        Raises
        ------
        RobotError
            The node does not run, or has not finished the call within 5 s.

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
            except Exception as error:  # it is for whoever waits
                in_loop(loop, settle, error, None)
            else:
                in_loop(loop, settle, None, value)

        deadline_s = time.monotonic() + _ANSWER_S
        while self._node.executor is None:
            if time.monotonic() > deadline_s:
                raise RobotError('The node of this server does not run.')
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
            Is called in the thread of the node, such as whether a server is there.

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
        """Wait until what runs can have been found; only shortly after the start."""
        await asyncio.sleep(max(0.0, self._begin_s + _SETTLED_S - time.monotonic()))

    async def newest(self, kind: Any, topic: str, profile: Any, missing: str) -> Any:
        """
        Return a message of a topic.

        Parameters
        ----------
        kind, topic, profile
            What to listen to.
        missing
            What to say if nobody publishes it.

        Raises
        ------
        RobotError
            None comes.

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
            raise RobotError(f"Nothing comes on '{name}'.") from None
        finally:
            executor = self._node.executor
            if executor is not None:
                executor.create_task(self._node.destroy_subscription, subscription)

    async def ask(self, client: Any, request: Any, who: str, timeout_s: float = _ANSWER_S) -> Any:
        """
        Return what a service answers.

        Parameters
        ----------
        client, request
            A client of the service, and what to ask.
        who
            What to call the service if it does not answer in time.
        timeout_s
            How long it may take.

        Raises
        ------
        RobotError
            It does not answer.

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
    """Set the result of a future, unless nobody waits for it any more."""
    if not future.done():
        future.set_result(value)


def in_loop(loop: asyncio.AbstractEventLoop, function: Callable[..., Any], *told: Any) -> None:
    """
    Call a function in the thread of a loop, which may be at its end.

    Parameters
    ----------
    loop, function, told
        The loop, what to call, and with which arguments.

    """
    try:
        loop.call_soon_threadsafe(function, *told)
    except RuntimeError:  # the loop is closed: nobody waits any more
        return
