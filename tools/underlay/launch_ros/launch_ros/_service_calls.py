# SPDX-License-Identifier: Apache-2.0
"""Call ROS services without blocking the event loop of the launch."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterator
from contextlib import contextmanager
import logging
from typing import Any, Optional

_POLL_S = 0.05
_PATIENCE_S = 10.0
_LOST_AFTER_S = 5.0


class ServiceGoneError(RuntimeError):
    """Nobody will answer a call; the text says why."""


class ServiceCaller:
    """Calls a service when it is there; a process that offers it may be known."""

    def __init__(
        self,
        client: Any,
        logger: logging.Logger,
        *,
        server: Optional[asyncio.Future[Any]] = None,
        is_ready: Optional[Callable[[], bool]] = None,
    ) -> None:
        """
        Create the caller.

        :param client: the rclpy client
        :param server: what is done when the process that offers the service has ended for good
        :param is_ready: what is true when a call makes sense; when there is a server by default
        """
        self._client = client
        self._name = client.srv_name
        self._logger = logger
        self._server = server
        self._is_ready: Callable[[], bool] = is_ready or client.service_is_ready

    async def call(self, request: Any) -> Any:
        """Wait for the service and return its answer; report if the launch ends meanwhile."""
        with self._abandoned('service'):
            await self._until_ready()
        with self._abandoned('service response'):
            return await self._answer(request)

    @contextmanager
    def _abandoned(self, what: str) -> Iterator[None]:
        try:
            yield
        except asyncio.CancelledError:
            self._logger.warning(
                "Abandoning wait for the '%s' %s, due to shutdown.", self._name, what
            )
            raise

    async def _until_ready(self) -> None:
        loop = asyncio.get_running_loop()
        late = loop.time() + _PATIENCE_S
        while not self._is_ready():
            self._require_server()
            await asyncio.sleep(_POLL_S)
            if loop.time() > late:
                self._logger.warning(
                    "still waiting for the service '%s', which no running node offers", self._name
                )
                late = float('inf')

    async def _answer(self, request: Any) -> Any:
        """Send the request; whoever was there and is not any more will not answer it."""
        loop = asyncio.get_running_loop()
        answered = asyncio.Event()
        pending = self._client.call_async(request)
        pending.add_done_callback(lambda _: loop.call_soon_threadsafe(answered.set))
        lost = loop.time() + _LOST_AFTER_S
        try:
            while not await _is_set_within(answered, 10 * _POLL_S):
                self._require_server()
                if self._client.service_is_ready():
                    lost = loop.time() + _LOST_AFTER_S
                elif loop.time() > lost:
                    raise ServiceGoneError(
                        f"the node that offers '{self._name}' has gone before it answered"
                    )
        finally:
            self._client.remove_pending_request(pending)
        return pending.result()

    def _require_server(self) -> None:
        if self._server is not None and self._server.done():
            raise ServiceGoneError(f"the process that offers '{self._name}' has ended")


async def _is_set_within(event: asyncio.Event, seconds: float) -> bool:
    try:
        await asyncio.wait_for(event.wait(), seconds)
    except asyncio.TimeoutError:
        return False
    return True
