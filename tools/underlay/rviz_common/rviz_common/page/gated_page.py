# SPDX-License-Identifier: Apache-2.0
"""What all pages have in common: a socket, URLs, access control, and routes."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import replace
from http import HTTPStatus
import ipaddress
import secrets
from types import TracebackType
from typing import TYPE_CHECKING
from urllib.parse import urlencode, urlsplit

from rviz_common.page.address import listen, NO_TOKEN, PageSettings, reachable
from rviz_common.page.admission import Admission, Refusal, sign_in_page, without_token
from rviz_common.page.routes import HTML, PLAIN, Route, Routes
from websockets.datastructures import Headers
from websockets.http11 import Request, Response

if TYPE_CHECKING:
    from typing_extensions import Self

__all__ = ['POLICY', 'GatedPage', 'text_response']

POLICY = "frame-ancestors 'self'"
"""Pages of other origins may not show this one in a frame."""


class GatedPage(ABC):
    """
    A page whose socket listens from the start; a subclass serves it.

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

    Attributes
    ----------
    title
        The title of the browser's tab.
    settings
        The host, the port and the token.
    socket
        The listening socket.
    port
        The port at which it is served.
    routes
        What is served at which path; routes may be added while the page is served.

    """

    def __init__(self, title: str, settings: PageSettings | None = None) -> None:
        settings = settings or PageSettings()
        if not settings.token:
            settings = replace(settings, token=secrets.token_urlsafe(16))
        self.title = title
        self.settings = settings
        self.socket = listen(settings)
        self.port: int = self.socket.getsockname()[1]
        self.routes = Routes()
        self._token = '' if settings.token == NO_TOKEN else settings.token
        self._admission = Admission(self.port, self._token)

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

    @property
    def shared_url(self) -> str:
        """The URL to open on another machine, such as a phone; '' if no other one reaches it."""
        host = ipaddress.ip_address(urlsplit(self.url).hostname or '')
        return '' if host.is_loopback else self.url

    @abstractmethod
    def close(self) -> None:
        """Stop serving the page."""

    def __enter__(self) -> Self:
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

    def response_to(
        self, request: Request, otherwise: Callable[[], Response | None]
    ) -> Response | None:
        """
        Respond to a request: reject it, store its token, or serve a route.

        Parameters
        ----------
        request
            The request.
        otherwise
            Returns the response to a request that is admitted, and not for a route.

        Returns
        -------
        Response | None
            None if the connection becomes a WebSocket.

        """
        headers = request.headers
        refusal = self._admission.refusal(
            request.path,
            ', '.join(headers.get_all('Host')),
            ', '.join(headers.get_all('Origin')) if 'Origin' in headers else None,
            '; '.join(headers.get_all('Cookie')),
        )
        if refusal is not None:
            return _refused(refusal, headers, self.title)
        if self._admission.brings_token(request.path) and 'Upgrade' not in headers:
            return _with_cookie(request.path, self._admission)
        route = self.routes.find(request.path)
        if route is None:
            return otherwise()
        return None if 'Upgrade' in headers else _served(route)


def text_response(status: HTTPStatus, text: str, kind: str = PLAIN) -> Response:
    """
    Build a response with a text.

    Parameters
    ----------
    status, text, kind
        Its status, its text, and the content type of that.

    """
    body = text.encode()
    headers = Headers({'Content-Type': kind, 'Content-Length': str(len(body))})
    headers['Connection'] = 'close'
    return Response(status, status.phrase, headers, body)


def _refused(refusal: Refusal, headers: Headers, title: str) -> Response:
    """Return the rejection of a request: a page for browsers, plain text for programs."""
    if refusal.wants_token and 'text/html' in ', '.join(headers.get_all('Accept')):
        heading = refusal.sentence.partition('. ')[0]
        text = sign_in_page(title, ', '.join(headers.get_all('Host')), f'{heading}.')
        response = text_response(refusal.status, text, HTML)
        response.headers['Content-Security-Policy'] = POLICY
        return response
    return text_response(refusal.status, f'{refusal.sentence}\n')


def _served(route: Route) -> Response:
    response = text_response(HTTPStatus.OK, route.content, route.kind)
    response.headers['Content-Security-Policy'] = POLICY
    return response


def _with_cookie(path: str, admission: Admission) -> Response:
    """Redirect the browser to the URL without the token, to keep it out of the history."""
    place = without_token(path)
    headers = Headers(
        {'Location': place, 'Set-Cookie': admission.set_cookie, 'Content-Length': '0'}
    )
    headers['Connection'] = 'close'
    return Response(HTTPStatus.SEE_OTHER, HTTPStatus.SEE_OTHER.phrase, headers)
