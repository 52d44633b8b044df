# SPDX-License-Identifier: Apache-2.0
"""Embedded pages of panels, with their own connections."""

from __future__ import annotations

from typing import Any, Protocol

from robot_console import phone_page
from robot_console.page_text import page_text, path_of
from rviz_common.context import Context
from rviz_common.page import Route
from rviz_common.page.web_files import frame_text
from websockets.asyncio.server import ServerConnection

__all__ = ['SmallPage', 'Talks']


class Talks(Protocol):
    """Server of the WebSocket connections of an embedded page."""

    async def talk(self, connection: ServerConnection) -> None:
        """
        Serve a connection of the page until it is closed, in the thread of the page server.

        Parameters
        ----------
        connection
            The WebSocket connection that a browser has opened.

        """

    def end(self) -> None:
        """Close all connections; called from another thread."""


class SmallPage:
    """
    The HTML page of a panel, embedded among the widgets as an iframe, with its own path.

    Parameters
    ----------
    context
        The context of the panel.
    name
        The name of the page: that of its HTML file, and the first part of its path.
    namespace
        The namespace of the robot, the rest of the path; '' if there is only one robot.
    settings
        The settings available to the page when it loads, as for `page_text`.
    connections
        The server of the WebSocket connections of the page; it is closed together with the page.
    order
        The order of the iframe among the widgets; None to append it.
    package
        The package that contains the HTML file.

    Raises
    ------
    ValueError
        Such a page already exists for this robot.

    """

    def __init__(
        self,
        context: Context,
        name: str,
        namespace: str,
        settings: dict[str, Any],
        connections: Talks,
        order: float | None = None,
        package: str = 'robot_console',
    ) -> None:
        self._context = context
        self._connections = connections
        self._name, self._namespace = name, namespace
        self._path = path_of(name, namespace)
        try:
            context.page.routes.add(
                self._path, Route(page_text(name, settings, package), connections.talk)
            )
        except ValueError:
            raise ValueError(
                f"This robot already has the page '{self._path}'. Remove one of the two from the "
                "file, or give it another 'Namespace'."
            ) from None
        phone_page.join(context.page, name, namespace, settings)
        self._frame = context.gui.add_markdown(frame_text(self._path, name), order=order)

    def close(self) -> None:
        """Remove the page, and close its connections."""
        phone_page.leave(self._context.page, self._name, self._namespace)
        self._context.page.routes.remove(self._path)
        self._connections.end()
        self._frame.remove()
