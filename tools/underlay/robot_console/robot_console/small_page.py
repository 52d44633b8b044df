# SPDX-License-Identifier: Apache-2.0
"""Embedded pages of panels, with their own connections."""

from __future__ import annotations

from importlib.resources import files
from typing import Any, Protocol

from rviz_common.context import Context
from rviz_common.page import Route
from rviz_common.page.web_files import filled, frame_text
from websockets.asyncio.server import ServerConnection

__all__ = ['SmallPage', 'Talks', 'page_text']

COMMON = ('common.css', 'link.js', 'live.css', 'live.js', 'stay.js')


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
        self._path = f'/{name}/{namespace}' if namespace else f'/{name}'
        try:
            context.page.routes.add(
                self._path, Route(page_text(name, settings, package), connections.talk)
            )
        except ValueError:
            raise ValueError(
                f"This robot already has the page '{self._path}'. Remove one of the two from the "
                "file, or give it another 'Namespace'."
            ) from None
        self._frame = context.gui.add_markdown(frame_text(self._path, name), order=order)

    def close(self) -> None:
        """Remove the page, and close its connections."""
        self._context.page.routes.remove(self._path)
        self._connections.end()
        self._frame.remove()


def page_text(name: str, settings: dict[str, Any], package: str = 'robot_console') -> str:
    """
    Read the HTML of an embedded page, and insert shared styles, scripts and settings.

    Parameters
    ----------
    name
        The name of the file in the folder `web`, without `.html`.
    settings
        The value of `settings` in the scripts of the page; must be serializable as JSON.
    package
        The package that contains the file.

    """
    folder = files('robot_console') / 'web'
    text = (files(package) / 'web' / f'{name}.html').read_text(encoding='utf-8')
    for part in COMMON:
        text = text.replace(f'/* {part} */', (folder / part).read_text(encoding='utf-8'))
    return filled(text, settings)
