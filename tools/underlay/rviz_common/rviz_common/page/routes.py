# SPDX-License-Identifier: Apache-2.0
"""Routes of a page: what it serves at which path, such as small pages embedded in it."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from urllib.parse import unquote, urlsplit

from websockets.asyncio.server import ServerConnection

__all__ = ['HTML', 'PLAIN', 'Route', 'Routes']

HTML, PLAIN = 'text/html; charset=utf-8', 'text/plain; charset=utf-8'


@dataclass(frozen=True)
class Route:
    """
    The resource at a path: the content of an HTTP response, and a handler of WebSocket clients.

    The connection is that of the `websockets` library, in the thread of the page.
    """

    content: str
    connect: Callable[[ServerConnection], Awaitable[None]] | None = None
    kind: str = HTML


class Routes:
    """Routes by path, such as `/drive`; they can be added while the page is served."""

    def __init__(self) -> None:
        self._by_path: dict[str, Route] = {}

    def add(self, path: str, route: Route) -> None:
        """
        Serve a route at a path.

        Parameters
        ----------
        path
            The path, such as `/drive`, without a trailing slash; '' is the root.
        route
            What to serve there.

        Raises
        ------
        ValueError
            There is already a route at this path.

        """
        if path in self._by_path:
            raise ValueError(f"The path '{path}' is already in use.")
        self._by_path[path] = route

    def remove(self, path: str) -> None:
        """
        Stop serving the route at a path; open connections are kept.

        Parameters
        ----------
        path
            The path that it was added with.

        """
        self._by_path.pop(path, None)

    def find(self, target: str) -> Route | None:
        """
        Find the route of a request.

        Parameters
        ----------
        target
            The target of the request: a path, possibly with a query and a trailing slash.

        Returns
        -------
        Route | None
            None if the request is for the page itself.

        """
        return self._by_path.get(unquote(urlsplit(target).path).rstrip('/'))
