# SPDX-License-Identifier: Apache-2.0
"""Wait in an event loop for what arrives in the thread of a node."""

from __future__ import annotations

import asyncio
from types import TracebackType
from typing import Any, Optional


class PendingAnswer:
    """A request that has been sent; on leaving, its answer is not waited for any more."""

    def __init__(self, client: Any, request: Any) -> None:
        """Send the request."""
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
        """Wait for the answer, but not longer than this."""
        try:
            await asyncio.wait_for(self._arrived.wait(), seconds)
        except asyncio.TimeoutError:
            return False
        return True

    def result(self) -> Any:
        """Return the answer that has arrived."""
        return self._future.result()
