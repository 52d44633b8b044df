# SPDX-License-Identifier: Apache-2.0
"""Who may see and use a page."""

from __future__ import annotations

from http import HTTPStatus

import pytest
from rviz_common.page.admission import Admission

LOCAL = Admission(8080)
SECRET = Admission(8080, 'secret')
HOST = '192.168.1.7:8080'


@pytest.mark.parametrize('host', ['127.0.0.1:8080', 'localhost:8080', '[::1]:8080'])
def test_this_machine(host: str) -> None:
    """A page is there for this machine under its own names, and for its own scripts."""
    assert LOCAL.refusal('/', host, None, None) is None
    assert LOCAL.refusal('/', host, f'http://{host}', None) is None


@pytest.mark.parametrize(
    'origin', ['http://evil.example', 'http://localhost:8081', 'null', '', 'http://127.0.0.1:8080']
)
def test_foreign_origin(origin: str) -> None:
    """Scripts of other sites, and of other ports of this machine, are refused."""
    refusal = LOCAL.refusal('/', 'localhost:8080', origin, None)
    assert refusal is not None
    assert refusal.status == HTTPStatus.FORBIDDEN


@pytest.mark.parametrize('host', ['evil.example:8080', 'localhost:1', 'localhost', ''])
def test_foreign_name(host: str) -> None:
    """A name that somebody else gave to this machine is refused, even if the origin has it too."""
    for origin in (None, f'http://{host}'):
        refusal = LOCAL.refusal('/', host, origin, None)
        assert refusal is not None
        assert refusal.status == HTTPStatus.FORBIDDEN


def test_token_missing() -> None:
    """Without the token of a page, a sentence says where it is."""
    refusal = SECRET.refusal('/', HOST, None, None)
    assert refusal is not None
    assert refusal.status == HTTPStatus.UNAUTHORIZED
    assert '?token=' in refusal.sentence


@pytest.mark.parametrize(
    ('path', 'cookies'),
    [
        ('/?token=wrong', None),
        ('/', 'token_8080=wrong'),
        ('/?token=sécret', None),
        ('/?token=wrong', 'token_8080=secret'),
    ],
)
def test_token_wrong(path: str, cookies: str | None) -> None:
    """A wrong token is refused, wherever it is."""
    refusal = SECRET.refusal(path, HOST, None, cookies)
    assert refusal is not None
    assert refusal.status == HTTPStatus.FORBIDDEN


@pytest.mark.parametrize(
    ('path', 'cookies'),
    [
        ('/?token=secret', None),
        ('/', 'token_8080=secret'),
        ('/', 'other=1; token_8080=secret; token_8081=x'),
    ],
)
def test_token_right(path: str, cookies: str | None) -> None:
    """The token admits, in the address and in the cookie."""
    assert SECRET.refusal(path, HOST, f'http://{HOST}', cookies) is None


@pytest.mark.parametrize('cookies', ['token_8081=secret', '=;;=', 'token_8080'])
def test_cookies_of_others(cookies: str) -> None:
    """The token of another port does not admit, and broken cookies harm nothing."""
    refusal = SECRET.refusal('/', HOST, None, cookies)
    assert refusal is not None
    assert refusal.status == HTTPStatus.UNAUTHORIZED


@pytest.mark.parametrize('token', ['a&b#c%d e;x', 'é, ü', 'a\r\nX: y', '"quoted\\"', ' '])
def test_strange_token(token: str) -> None:
    """Whatever is in a token, the cookie that is set brings it, and breaks no header."""
    admission = Admission(8080, token)
    header = admission.set_cookie
    assert header.isascii() and header.isprintable() and header.count(';') == 3
    assert admission.refusal('/', HOST, None, header.partition(';')[0]) is None
    assert admission.refusal('/', HOST, None, f'{admission.cookie}=x') is not None


@pytest.mark.parametrize(('path', 'origin'), [('//[::1', None), ('/', 'http://[::1')])
def test_no_address(path: str, origin: str | None) -> None:
    """What is no address is refused, too."""
    refusal = LOCAL.refusal(path, 'localhost:8080', origin, None)
    assert refusal is not None
    assert refusal.status == HTTPStatus.BAD_REQUEST
