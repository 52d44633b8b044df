# SPDX-License-Identifier: Apache-2.0
"""A page of viser, and the access control that its server lacks."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager
import functools
from typing import Any

import rich
from rviz_common.page.address import PageSettings
from rviz_common.page.client_html import adapted
from rviz_common.page.connection_log import complain_about_task, LOGGER
from rviz_common.page.gated_page import GatedPage, POLICY
from rviz_common.page.message_filter import OptionsOf, Strained, Uploads
from rviz_common.page.viser_connection import connection_of
from rviz_common.page.watchdog import serving
import viser
from viser._messages import FileTransferPartAck, FileTransferStartUpload, RemoveNotificationMessage
import websockets.asyncio.server
from websockets.asyncio.server import ServerConnection
from websockets.http11 import Request, Response

__all__ = ['Page', 'set_theme']


class Page(GatedPage):
    """
    A page with a scene and widgets of `viser`; it is served from the start.

    Parameters
    ----------
    title, settings
        As for `GatedPage`.

    Raises
    ------
    PortError
        The host or the port cannot be used.
    RuntimeError
        This version of viser starts its server in a way that cannot be secured.

    Attributes
    ----------
    uploads
        Limits the files that browsers upload.
    viser
        The `viser.ViserServer`, with the scene and the widgets.

    """

    def __init__(self, title: str, settings: PageSettings | None = None) -> None:
        super().__init__(title, settings)
        self._name, self._icon, self._small_page = title, '', ''
        self._is_closed = False
        rich.get_console().quiet = True  # viser prints addresses, but not the token
        self.uploads = Uploads()
        with _gated(self, self._options_of):
            self.viser = viser.ViserServer(
                host=self.settings.host, port=self.port, label=title, verbose=False
            )
        set_theme(self.viser.gui, is_dark=True)
        self.viser.gui.main_panel.dock_right()
        # Shadows halve the frame rate with software rendering.
        self.viser.scene.configure_default_lights(cast_shadow=False)

    def end_upload(self, start: FileTransferStartUpload) -> None:
        """
        Make browsers stop showing the progress of an upload that was rejected.

        They would show it as uploaded instead, so that their notification is removed too.

        Parameters
        ----------
        start
            The announcement of the file by the browser.

        """
        complete = FileTransferPartAck(
            start.source_component_uuid,
            start.transfer_uuid,
            transferred_bytes=start.size_bytes,
            total_bytes=start.size_bytes,
        )
        for client in self.viser.get_clients().values():
            for message in (complete, RemoveNotificationMessage(f'upload-{start.transfer_uuid}')):
                connection_of(client.gui).queue_message(message)

    def present(self, name: str, icon: str = '') -> None:
        """
        Name the page in browsers, from when they load it: in their tabs and above the widgets.

        The page is still found under `title`, which the log and the page that asks for the token
        mention.

        Parameters
        ----------
        name
            The name, as plain text.
        icon
            The icon of the browser's tab, as the text of an SVG file; '' for that of viser.

        """
        self._name, self._icon = name, icon
        if not self._is_closed:
            self.viser.gui.set_panel_label(name)

    def lead_small_screens(self, path: str) -> None:
        """
        Lead browsers with a small screen to another page, from when they load this one.

        Parameters
        ----------
        path
            The path of the page for small screens; '' if they stay here.

        """
        self._small_page = path

    def adapt(self, response: Response) -> None:
        """
        Put the name, the icon and the way to the page for small screens into a response.

        Responses that are not HTML stay as they are.

        Parameters
        ----------
        response
            The response of viser, possibly compressed with gzip; it is changed in place.

        """
        if not response.headers.get('Content-Type', '').startswith('text/html'):
            return
        is_packed = response.headers.get('Content-Encoding') == 'gzip'
        response.body = adapted(
            bytes(response.body), self._name, self._icon, self._small_page, is_packed
        )
        del response.headers['Content-Length']
        response.headers['Content-Length'] = str(len(response.body))

    def _options_of(self, widget: str) -> tuple[str, ...] | None:
        """Return the options of a choice widget, None if there is no such widget."""
        handle = self.viser.gui._gui_input_handle_from_uuid.get(widget)
        options: tuple[str, ...] | None = getattr(handle, 'options', None)
        return options

    def close(self) -> None:
        """Stop serving the page."""
        self._is_closed = True
        self.viser.stop()


def set_theme(gui: viser.GuiApi, is_dark: bool) -> None:
    """
    Set the theme of the widgets.

    Parameters
    ----------
    gui
        The widgets of all browsers, or of one.
    is_dark
        Whether the theme is dark.

    """
    gui.configure_theme(
        control_width='large',
        dark_mode=is_dark,
        show_logo=False,
        show_share_button=False,
    )


# Larger than the chunks of half a megabyte in which browsers send files.
LARGEST_BYTES = 2_000_000


@contextmanager
def _gated(page: Page, options_of: OptionsOf) -> Iterator[None]:
    """
    Secure the viser server that is started in a `with` block.

    It gives the server a socket, a title, access control and limits. For this it replaces
    `websockets.asyncio.server.serve` for the duration of the block.

    Parameters
    ----------
    page
        The page that the server serves.
    options_of
        Returns the options of a choice widget.

    Yields
    ------
    None
        While the server can be started, once.

    Raises
    ------
    RuntimeError
        No server has been started in this way, or more than one.

    """
    serve = websockets.asyncio.server.serve
    used: list[bool] = []

    @functools.wraps(serve)
    def serve_gated(handler: Any, host: Any, port: Any, **options: Any) -> Any:
        if used:
            raise RuntimeError('The page has already been started.')
        used.append(True)
        answer = _answering(page, options.pop('process_request'))
        options.update(process_request=answer, max_size=LARGEST_BYTES, logger=LOGGER)
        asyncio.get_running_loop().set_exception_handler(complain_about_task)
        return serve(_routed(handler, page, options_of), sock=page.socket, **options)

    websockets.asyncio.server.serve = serve_gated  # type: ignore[assignment, misc]
    try:
        yield
    finally:
        websockets.asyncio.server.serve = serve  # type: ignore[misc]
    if not used:
        raise RuntimeError('The page is not protected: this version of viser starts differently.')


def _answering(page: Page, answer: Any) -> Any:
    """Wrap the request handler of viser, for requests that are admitted and not for a route."""

    def process_request(connection: ServerConnection, request: Request) -> Response | None:
        def of_viser() -> Response | None:
            response: Response | None = answer(connection, request)
            if response is not None:
                response.headers['Content-Security-Policy'] = POLICY
                page.adapt(response)
            return response

        return page.response_to(request, of_viser)

    return process_request


def _routed(handler: Any, page: Page, options_of: OptionsOf) -> Any:
    """Wrap the connection handler, to dispatch connections to a route or to viser."""

    async def talk(connection: ServerConnection) -> None:
        request = connection.request
        route = page.routes.find(request.path) if request else None
        if route is None or route.connect is None:
            strained = Strained(connection, page.uploads, options_of)
            try:
                with serving(connection):
                    await handler(strained)
            finally:
                page.uploads.leave(strained)
        else:
            await route.connect(connection)

    return talk
