# SPDX-License-Identifier: Apache-2.0
"""Wait in an event loop for a service response that arrives in the executor thread."""

from __future__ import annotations

import asyncio
from types import TracebackType
from typing import Any, Optional


class PendingAnswer:
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

    def __enter__(self) -> PendingAnswer:
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
