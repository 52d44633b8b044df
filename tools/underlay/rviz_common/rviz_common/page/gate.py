# SPDX-License-Identifier: Apache-2.0
"""How the viser server of a page is secured, which has no access control of its own."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager
import functools
import gzip
from html import escape
from http import HTTPStatus
import socket
from typing import Any

from rviz_common.page.admission import Admission, Refusal, sign_in_page, without_token
from rviz_common.page.message_filter import complain_about_task, LOGGER, OptionsOf, Strained
from rviz_common.page.routes import Route, Routes
from rviz_common.page.uploads import Uploads
import websockets.asyncio.server
from websockets.asyncio.server import ServerConnection
from websockets.datastructures import Headers
from websockets.http11 import Request, Response

__all__ = ['gated']

# Larger than the chunks of half a megabyte in which browsers send files.
LARGEST_BYTES = 2_000_000
# What a page may load and do: only from this origin, and not framed by other pages.
POLICY = "frame-ancestors 'self'"

OF_VISER = b'<title>Viser</title>'


@contextmanager
def gated(
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
