# SPDX-License-Identifier: Apache-2.0
"""
Who may use a page, and what users without its token see instead.

A browser lets any site that it shows connect to servers on this machine; it only reports the
site, in the header `Origin`. And the owner of a site can make the DNS resolve any name to this
machine (DNS rebinding); then the header `Host` has that name.
"""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from http import HTTPStatus
from http.cookies import CookieError, SimpleCookie
import secrets
import string
from urllib.parse import parse_qs, quote, unquote, urlsplit

__all__ = ['Admission', 'Refusal', 'sign_in_page', 'without_token']

OWN_NAMES = ('127.0.0.1', 'localhost', '[::1]')

PAGE = string.Template("""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>$title: token needed</title>
<style>
  :root { color-scheme: light dark; --text: light-dark(#111, #fff); }
  body { margin: 0; background: light-dark(#fff, #1a1b1e);
    color: light-dark(#33373d, #c9cbcf); font: 16px/1.5 system-ui, sans-serif; }
  main { max-width: 36rem; margin: 12vh auto 0; padding: 0 1.5rem; }
  h1 { color: var(--text); font-size: 1.5rem; }
  code { color: var(--text); background: light-dark(#eceef1, #2c2e33); }
  code { border-radius: 4px; padding: .1em .35em; }
  code { overflow-wrap: anywhere; }
  form { display: flex; gap: .5rem; margin: 1.5rem 0; }
  input { flex: 1; min-width: 0; }
  input, button { font: inherit; padding: .5rem .75rem; border-radius: 4px; }
  input { color: var(--text); background: light-dark(#fff, #25262b); border: 1px solid #868e96; }
  ::placeholder { color: light-dark(#5a5f66, #aeb0b6); opacity: 1; }
  button { color: #fff; background: #1971c2; border: 0; cursor: pointer; }
</style>
</head>
<body>
<main>
<h1>$heading</h1>
<p>Anyone who opens this page can drive a robot, so its address has a token that changes at
each start. Open the whole address that was printed in the terminal where this was started:</p>
<p><code>$title is at http://$host/?token=...</code></p>
<p>or enter the token here. This browser keeps it until the next start.</p>
<form action="/" method="get">
<input name="token" aria-label="Token" placeholder="Token" autocomplete="off" autofocus required>
<button>Open</button>
</form>
<p>No access to the terminal? The log has the address, too. On the machine where it runs:</p>
<p><code>grep -rh 'at http://.*token=' ~/.ros/log</code></p>
<p>Choose a token with <code>token:=TEXT</code>, or do without one on a machine that only you use
with <code>token:=none</code>.</p>
</main>
</body>
</html>
""")


@dataclass(frozen=True)
class Refusal:
    """The reason why a request is rejected, and whether a token would admit it."""

    status: HTTPStatus
    sentence: str
    wants_token: bool = False


@dataclass(frozen=True)
class Admission:
    """Access control of a port; without a token it admits all users of this machine."""

    port: int
    token: str = ''

    @property
    def cookie(self) -> str:
        """The name of the cookie with the token, unique per port, as cookies ignore ports."""
        return f'token_{self.port}'

    def refusal(
        self, path: str, host: str, origin: str | None, cookies: str | None
    ) -> Refusal | None:
        """
        Decide on a request from its path and headers.

        Parameters
        ----------
        path
            The path of the request, with its query.
        host, origin, cookies
            The headers `Host`, `Origin` and `Cookie`; the latter two are None if missing.

        Returns
        -------
        Refusal | None
            Why the request is rejected, None if it is admitted.

        """
        if not all(map(_is_address, (path, origin or ''))):
            return Refusal(HTTPStatus.BAD_REQUEST, 'This is not a valid address.')
        if origin is not None and urlsplit(origin).netloc != host:
            return Refusal(
                HTTPStatus.FORBIDDEN,
                f'Pages of {origin} may not use this page, which is at {host}.',
            )
        if not self.token:
            return self._refusal_of_name(host)
        given = self._token_of(path, cookies)
        if not given:
            return Refusal(
                HTTPStatus.UNAUTHORIZED,
                'This page needs a token. Open the address with ?token= that was printed at the '
                'start.',
                wants_token=True,
            )
        if not secrets.compare_digest(given.encode(), self.token.encode()):
            return Refusal(
                HTTPStatus.FORBIDDEN,
                'The token is wrong. Open the address that was printed at the last start.',
                wants_token=True,
            )
        return None

    @property
    def set_cookie(self) -> str:
        """The header that makes a browser store the token."""
        return f'{self.cookie}={quote(self.token, safe="")}; HttpOnly; SameSite=Strict; Path=/'

    def brings_token(self, path: str) -> bool:
        """
        Whether a request has a token in its query, which is then to be stored in a cookie.

        Parameters
        ----------
        path
            The path of the request, with its query.

        Returns
        -------
        bool
            Always False if the page needs no token.

        """
        return bool(self.token and _token_in(path))

    def _refusal_of_name(self, host: str) -> Refusal | None:
        """Reject names of this machine that are not its own."""
        if host in {f'{name}:{self.port}' for name in OWN_NAMES}:
            return None
        return Refusal(
            HTTPStatus.FORBIDDEN,
            f"This page is not at '{host}'. Open http://localhost:{self.port}.",
        )

    def _token_of(self, path: str, cookies: str | None) -> str:
        try:
            cookie = SimpleCookie(cookies or '').get(self.cookie)
        except CookieError:
            cookie = None
        return _token_in(path) or (unquote(cookie.value) if cookie else '')


def _is_address(text: str) -> bool:
    try:
        urlsplit(text)
    except ValueError:
        return False
    return True


def without_token(path: str) -> str:
    """
    Remove the token from the path of a request, to redirect a browser there.

    Parameters
    ----------
    path
        The path, with its query.

    Returns
    -------
    str
        The path on this host, with the rest of the query.

    """
    # Two leading slashes would redirect to another host.
    place, _, query = path.partition('#')[0].partition('?')
    rest = [each for each in query.split('&') if each and each.partition('=')[0] != 'token']
    return '/' + place.lstrip('/\\') + ('?' if rest else '') + '&'.join(rest)


def _token_in(path: str) -> str:
    """Return the token in the query of a path, or an empty one."""
    return parse_qs(urlsplit(path).query).get('token', [''])[0]


def sign_in_page(title: str, host: str, heading: str) -> str:
    """
    Return the HTML of the page that asks for a token.

    Parameters
    ----------
    title
        The title of the page that it leads to.
    host
        The host name that the browser used, with the port.
    heading
        What is missing or wrong.

    """
    return PAGE.substitute(title=escape(title), host=escape(host), heading=escape(heading))
