# SPDX-License-Identifier: Apache-2.0
"""A page without viser: it starts at once, and consists of its routes only."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from http import HTTPStatus
import threading

from rviz_common.page.address import PageSettings
from rviz_common.page.connection_log import complain_about_task, LOGGER
from rviz_common.page.gated_page import GatedPage, text_response
from rviz_common.page.routes import Route
from websockets.asyncio.server import serve, ServerConnection
from websockets.http11 import Request, Response

__all__ = ['PlainPage']

CLOSE_S = 1.0
"""How long a browser has to answer that the page closes."""


class PlainPage(GatedPage):
    """
    A page that consists of its routes, served from the start in a thread of its own.

    Parameters
    ----------
    title, settings
        As for `GatedPage`.
    routes
        What is served, by path; '' is the page itself.

    Raises
    ------
    PortError
        The host or the port cannot be used.

    """

    def __init__(
        self, title: str, routes: Mapping[str, Route], settings: PageSettings | None = None
    ) -> None:
        super().__init__(title, settings)
        for path, route in routes.items():
            self.routes.add(path, route)
        self._loop = asyncio.new_event_loop()
        self._end = asyncio.Event()
        self._thread = threading.Thread(target=self._run, name='page', daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Close all connections, and stop serving the page."""
        if self._thread.is_alive():
            self._loop.call_soon_threadsafe(self._end.set)
            self._thread.join()

    def _run(self) -> None:
        asyncio.set_event_loop(self._loop)
        self._loop.set_exception_handler(complain_about_task)
        self._loop.run_until_complete(self._serve())
        self._loop.close()

    async def _serve(self) -> None:
        async with serve(
            self._talk,
            sock=self.socket,
            process_request=self._answer,
            compression=None,  # messages are small, and stay on this machine as a rule
            close_timeout=CLOSE_S,
            logger=LOGGER,
        ):
            await self._end.wait()

    def _answer(self, connection: ServerConnection, request: Request) -> Response | None:
        return self.response_to(request, _not_found)

    async def _talk(self, connection: ServerConnection) -> None:
        route = self.routes.find(connection.request.path) if connection.request else None
        if route is not None and route.connect is not None:
            await route.connect(connection)


def _not_found() -> Response:
    return text_response(HTTPStatus.NOT_FOUND, 'There is nothing at this address.\n')
