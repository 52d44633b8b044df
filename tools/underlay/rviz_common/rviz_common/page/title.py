# SPDX-License-Identifier: Apache-2.0
"""Set the title of the browser's tab, in place of that of viser."""

from __future__ import annotations

from functools import lru_cache
import gzip
from html import escape

from websockets.http11 import Response

__all__ = ['entitle']

OF_VISER = b'<title>Viser</title>'


def entitle(response: Response, title: str) -> None:
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


@lru_cache(maxsize=4)
def _entitled(body: bytes, title: str, is_packed: bool) -> bytes:
    text = gzip.decompress(body) if is_packed else body
    text = text.replace(OF_VISER, f'<title>{escape(title)}</title>'.encode())
    return gzip.compress(text, 6) if is_packed else text
