# SPDX-License-Identifier: Apache-2.0
"""A page in the browser, and the access control that its viser server lacks."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
import functools
import gzip
from html import escape
from http import HTTPStatus
import secrets
import socket
from types import TracebackType
from typing import Any
from urllib.parse import urlencode

import rich
from rviz_common.page.address import listen, NO_TOKEN, PageSettings, reachable
from rviz_common.page.admission import Admission, Refusal, sign_in_page, without_token
from rviz_common.page.message_filter import (
    complain_about_task,
    LOGGER,
    OptionsOf,
    Strained,
    Uploads,
)
from rviz_common.page.routes import Route, Routes
import viser
from viser._messages import FileTransferPartAck, FileTransferStartUpload, RemoveNotificationMessage
import websockets.asyncio.server
from websockets.asyncio.server import ServerConnection
from websockets.datastructures import Headers
from websockets.http11 import Request, Response

__all__ = ['Page']


class Page:
    """
    A page with a scene and widgets of `viser`; it is served from the start.

    Parameters
    ----------
    title
        The title of the browser's tab.
    settings
        The host, the port and the token; by default it is served at 127.0.0.1. An empty token is
        replaced by a generated one.

    Raises
    ------
    PortError
        The host or the port cannot be used.
    RuntimeError
        This version of viser starts its server in a way that cannot be secured.

    Attributes
    ----------
    port
        The port at which it is served.
    routes
        Routes served in addition to the page itself.
    uploads
        Limits the files that browsers upload.
    viser
        The `viser.ViserServer`, with the scene and the widgets.

    """

    def __init__(self, title: str, settings: PageSettings | None = None) -> None:

        settings = settings or PageSettings()
        if not settings.token:
            settings = replace(settings, token=secrets.token_urlsafe(16))
        rich.get_console().quiet = True  # viser prints addresses, but not the token
        bound = listen(settings)
        self.settings = settings
        self.port: int = bound.getsockname()[1]
        self.routes = Routes()
        self.uploads = Uploads()
        self._token = '' if settings.token == NO_TOKEN else settings.token
        admission = Admission(self.port, self._token)
        with _gated(bound, title, admission, self.routes, self.uploads, self._options_of):
            self.viser = viser.ViserServer(
                host=settings.host, port=self.port, label=title, verbose=False
            )
        self.viser.gui.configure_theme(
            control_width='large',
            dark_mode=True,
            show_logo=False,
            show_share_button=False,
        )
        self.viser.gui.main_panel.dock_right()
        # Shadows halve the frame rate with software rendering.
        self.viser.scene.configure_default_lights(cast_shadow=False)

    @property
    def urls(self) -> list[str]:
        """The URLs to open, with the token if there is one; the best one first."""
        query = f'?{urlencode({"token": self._token})}' if self._token else ''
        hosts = [f'[{each}]' if ':' in each else each for each in reachable(self.settings.host)]
        return [f'http://{host}:{self.port}/{query}' for host in hosts]

    @property
    def url(self) -> str:
        """The URL to open."""
        return self.urls[0]

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
                client.gui._websock_interface.queue_message(message)

    def _options_of(self, widget: str) -> tuple[str, ...] | None:
        """Return the options of a choice widget, None if there is no such widget."""
        handle = self.viser.gui._gui_input_handle_from_uuid.get(widget)
        options: tuple[str, ...] | None = getattr(handle, 'options', None)
        return options

    def close(self) -> None:
        """Stop serving the page."""
        self.viser.stop()

    def __enter__(self) -> Page:
        """Return the page."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close the page."""
        self.close()


# Larger than the chunks of half a megabyte in which browsers send files.
LARGEST_BYTES = 2_000_000
# What a page may load and do: only from this origin, and not framed by other pages.
POLICY = "frame-ancestors 'self'"

OF_VISER = b'<title>Viser</title>'


@contextmanager
def _gated(
    bound: socket.socket,
    title: str,
    admission: Admission,
    routes: Routes,
    uploads: Uploads,
    options_of: OptionsOf,
) -> Iterator[None]:
    """
    Secure the viser server that is started in a `with` block.

    It gives the server a socket, a title, access control and limits. For this it replaces
    `websockets.asyncio.server.serve` for the duration of the block.

    Parameters
    ----------
    bound
        The listening socket that the server is to use.
    title
        The title of the browser's tab.
    admission
        Decides who may use the page.
    routes
        Routes served in addition to the viser page.
    uploads
        Limits the files that browsers upload.
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
        answer = _gate(options.pop('process_request'), title, admission, routes)
        options.update(process_request=answer, max_size=LARGEST_BYTES, logger=LOGGER)
        asyncio.get_running_loop().set_exception_handler(complain_about_task)
        return serve(_routed(handler, routes, uploads, options_of), sock=bound, **options)

    websockets.asyncio.server.serve = serve_gated  # type: ignore[assignment, misc]
    try:
        yield
    finally:
        websockets.asyncio.server.serve = serve  # type: ignore[misc]
    if not used:
        raise RuntimeError('The page is not protected: this version of viser starts differently.')


def _routed(handler: Any, routes: Routes, uploads: Uploads, options_of: OptionsOf) -> Any:
    """Wrap the connection handler, to dispatch connections to a route or to viser."""

    async def talk(connection: ServerConnection) -> None:
        request = connection.request
        route = routes.find(request.path) if request else None
        if route is None or route.connect is None:
            strained = Strained(connection, uploads, options_of)
            try:
                await handler(strained)
            finally:
                uploads.leave(strained)
        else:
            await route.connect(connection)

    return talk


def _gate(answer: Any, title: str, admission: Admission, routes: Routes) -> Any:
    """Wrap the request handler, to reject requests that are not admitted."""

    def process_request(connection: ServerConnection, request: Request) -> Response | None:
        headers = request.headers
        refusal = admission.refusal(
            request.path,
            ', '.join(headers.get_all('Host')),
            ', '.join(headers.get_all('Origin')) if 'Origin' in headers else None,
            '; '.join(headers.get_all('Cookie')),
        )
        if refusal is not None:
            return _refused(refusal, headers, title)
        if admission.brings_token(request.path) and 'Upgrade' not in headers:
            return _with_cookie(request.path, admission)
        route = routes.find(request.path)
        if route is not None:
            return None if 'Upgrade' in headers else _served(route)
        response: Response | None = answer(connection, request)
        if response is not None:
            response.headers['Content-Security-Policy'] = POLICY
            _entitle(response, title)
        return response

    return process_request


def _refused(refusal: Refusal, headers: Headers, title: str) -> Response:
    """Return the rejection of a request: a page for browsers, plain text for programs."""
    if refusal.wants_token and 'text/html' in ', '.join(headers.get_all('Accept')):
        heading = refusal.sentence.partition('. ')[0]
        text = sign_in_page(title, ', '.join(headers.get_all('Host')), f'{heading}.')
        response = _answer(refusal.status, text, 'text/html; charset=utf-8')
        response.headers['Content-Security-Policy'] = POLICY
        return response
    return _answer(refusal.status, f'{refusal.sentence}\n', 'text/plain; charset=utf-8')


def _served(route: Route) -> Response:
    response = _answer(HTTPStatus.OK, route.content, route.kind)
    response.headers['Content-Security-Policy'] = POLICY
    return response


def _answer(status: HTTPStatus, text: str, kind: str) -> Response:
    body = text.encode()
    headers = Headers({'Content-Type': kind, 'Content-Length': str(len(body))})
    headers['Connection'] = 'close'
    return Response(status, status.phrase, headers, body)


def _with_cookie(path: str, admission: Admission) -> Response:
    """Redirect the browser to the URL without the token, to keep it out of the history."""
    place = without_token(path)
    headers = Headers(
        {'Location': place, 'Set-Cookie': admission.set_cookie, 'Content-Length': '0'}
    )
    headers['Connection'] = 'close'
    return Response(HTTPStatus.SEE_OTHER, HTTPStatus.SEE_OTHER.phrase, headers)


def _entitle(response: Response, title: str) -> None:
    """
    Replace the title of the page in a response; responses that are not HTML stay as they are.

    Parameters
    ----------
    response
        The response of viser, possibly compressed with gzip; it is changed in place.
    title
        The title of the browser's tab, as plain text.

    """
    if not response.headers.get('Content-Type', '').startswith('text/html'):
        return
    is_packed = response.headers.get('Content-Encoding') == 'gzip'
    response.body = _entitled(bytes(response.body), title, is_packed)
    del response.headers['Content-Length']
    response.headers['Content-Length'] = str(len(response.body))


@functools.lru_cache(maxsize=4)
def _entitled(body: bytes, title: str, is_packed: bool) -> bytes:
    text = gzip.decompress(body) if is_packed else body
    text = text.replace(OF_VISER, f'<title>{escape(title)}</title>'.encode())
    return gzip.compress(text, 6) if is_packed else text
