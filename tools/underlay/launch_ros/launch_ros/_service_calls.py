# SPDX-License-Identifier: Apache-2.0
"""Call services of a node without blocking the event loop of the launch."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager
import logging
from types import TracebackType
from typing import Any, Optional

from rcl_interfaces.srv import GetParameterTypes

STARTED_ANEW = 'started anew'
"""Cancellation message for calls that are repeated after a respawn."""

_POLL_S = 0.05
_CHECK_S = 0.5
_PATIENCE_S = 10.0
_LOST_AFTER_S = 5.0
_NO_PROBE_AFTER_S = 1.0


class ServiceGoneError(RuntimeError):
    """A service call will get no response; the message states why."""


class ServiceCaller:
    """
    Service client that calls a service of a node as soon as it is available.

    A node that was just discovered may not have discovered this client yet, and then drops its
    responses. A harmless probe (GetParameterTypes) is therefore sent first, and repeated until it
    is answered. As the probe client is created after the service client and after all earlier
    subscriptions, its response shows that the node has discovered those as well.

    Parameters
    ----------
    ros_node
        The launch's own rclpy node, which is spun in another thread.
    service_type
        The class of the service, such as `composition_interfaces.srv.LoadNode`.
    node_name
        The fully qualified name of the node that offers the service.
    service
        The service name, relative to that of the node.
    logger
        Logger for warnings about a late or abandoned service.
    server
        Done when the process of the node has ended for good; None if not started by this launch.

    Attributes
    ----------
    has_asked
        Whether a request has been sent, which a dying server may have lost.

    """

    def __init__(
        self,
        ros_node: Any,
        service_type: Any,
        node_name: str,
        service: str,
        logger: logging.Logger,
        server: Optional[asyncio.Future[Any]] = None,
    ) -> None:
        self._ros_node = ros_node
        self._name = f'{node_name}/{service}'
        self._client = ros_node.create_client(service_type, self._name)
        self._probe = ros_node.create_client(GetParameterTypes, f'{node_name}/get_parameter_types')
        self._logger = logger
        self._server = server
        self.has_asked = False
        """Whether a request has been sent, which a dying server may have lost."""

    def close(self) -> None:
        """Destroy the service clients."""
        self._ros_node.destroy_client(self._probe)
        self._ros_node.destroy_client(self._client)

    async def call(self, request: Any) -> Any:
        """
        Wait for the service, send a request, and wait for the response.

        A cancellation in the meantime is logged as due to shutdown, except with `STARTED_ANEW`.

        Parameters
        ----------
        request
            The request message of the service.

        Returns
        -------
        Any
            The response message.

        Raises
        ------
        ServiceGoneError
            The process of the node has ended, or the service disappeared before it responded.

        """
        with self._abandoned('service'):
            await self._until_ready()
            await self._until_heard()
        with self._abandoned('service response'):
            return await self._answer(request)

    def report_abandoned(self, what: str = 'service') -> None:
        """
        Log that the wait for the service is abandoned due to shutdown.

        Parameters
        ----------
        what
            The awaited object: `service` or `service response`.

        """
        self._logger.warning("Abandoning wait for the '%s' %s, due to shutdown.", self._name, what)

    @contextmanager
    def _abandoned(self, what: str) -> Iterator[None]:
        try:
            yield
        except asyncio.CancelledError as error:
            if STARTED_ANEW not in error.args:
                self.report_abandoned(what)
            raise

    async def _until_ready(self) -> None:
        patience = _Patience(self._logger)
        while not self._client.service_is_ready():
            self._require_server()
            await asyncio.sleep(_POLL_S)
            patience.check("the service '%s', which no running node offers", self._name)

    async def _until_heard(self) -> None:
        """Send the probe until it is answered; skip nodes without parameter services."""
        patience = _Patience(self._logger)
        no_probe = _now() + _NO_PROBE_AFTER_S
        while True:
            self._require_server()
            if self._probe.service_is_ready():
                with _PendingAnswer(self._probe, GetParameterTypes.Request()) as pending:
                    if await pending.arrives_within(_CHECK_S):
                        return
                patience.check("the node that offers '%s', which is busy", self._name)
            elif _now() > no_probe:
                return
            else:
                await asyncio.sleep(_POLL_S)

    async def _answer(self, request: Any) -> Any:
        """Send the request; raise an error if the server disappears before its response."""
        self.has_asked = True
        lost = _now() + _LOST_AFTER_S
        with _PendingAnswer(self._client, request) as pending:
            while not await pending.arrives_within(_CHECK_S):
                self._require_server()
                if self._client.service_is_ready():
                    lost = _now() + _LOST_AFTER_S
                elif _now() > lost:
                    raise ServiceGoneError(
                        f"the node that offers '{self._name}' has gone before it answered"
                    )
            return pending.result()

    def _require_server(self) -> None:
        if self._server is not None and self._server.done():
            raise ServiceGoneError(f"the process that offers '{self._name}' has ended")


class _Patience:
    """Logs a single warning if a wait takes long."""

    def __init__(self, logger: logging.Logger) -> None:
        self._logger = logger
        self._late = _now() + _PATIENCE_S

    def check(self, what: str, name: str) -> None:
        if _now() > self._late:
            self._logger.warning(f'still waiting for {what}', name)
            self._late = float('inf')


def _now() -> float:
    return asyncio.get_running_loop().time()


class _PendingAnswer:
    """
    Pending service request of an event loop; leaving the context drops the response.

    Parameters
    ----------
    client
        The rclpy client that sends the request. Its node is spun in another thread.
    request
        The request message of the service.

    Raises
    ------
    RuntimeError
        No event loop is running in this thread.

    """

    def __init__(self, client: Any, request: Any) -> None:
        loop = asyncio.get_running_loop()
        self._client = client
        self._arrived = asyncio.Event()
        self._future = client.call_async(request)
        self._future.add_done_callback(lambda _: loop.call_soon_threadsafe(self._arrived.set))

    def __enter__(self) -> _PendingAnswer:
        return self

    def __exit__(
        self,
        kind: Optional[type[BaseException]],
        error: Optional[BaseException],
        traceback: Optional[TracebackType],
    ) -> None:
        self._client.remove_pending_request(self._future)

    async def arrives_within(self, seconds: float) -> bool:
        """
        Wait for the service response with a timeout.

        Parameters
        ----------
        seconds
            The timeout in s.

        Returns
        -------
        bool
            Whether the response has arrived; then `result` returns it.

        """
        try:
            await asyncio.wait_for(self._arrived.wait(), seconds)
        except asyncio.TimeoutError:
            return False
        return True

    def result(self) -> Any:
        """Return the response that has arrived."""
        return self._future.result()
