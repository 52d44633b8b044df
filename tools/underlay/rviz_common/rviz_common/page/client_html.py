# SPDX-License-Identifier: Apache-2.0
"""What is changed in the HTML of the client of viser: title, icon, styles, and how it draws."""

from __future__ import annotations

import functools
import gzip
from html import escape
import json
import re
from urllib.parse import quote

from rviz_common.page.web_files import web_file

__all__ = ['adapted']

TITLE = b'<title>Viser</title>'
ICON = re.compile(rb'(<link\s+rel="icon"\s+href=")[^"]*"')
# On screens below 576 pixels, the widgets of viser are in a sheet that covers the scene.
SMALL = '(max-width: 575px), (max-height: 500px) and (pointer: coarse)'
SCRIPT = """
<script>{
  const asked = new URLSearchParams(location.search), path = %s;
  const isLed = path && window === top && !asked.has('full') && matchMedia('%s').matches;
  if (asked.has('scene')) document.documentElement.classList.add('scene-only');
  else if (isLed) location.replace(path + location.search);
}</script>"""


@functools.lru_cache(maxsize=4)
def adapted(body: bytes, name: str, icon: str, small_page: str, is_packed: bool) -> bytes:
    """
    Adapt the HTML of viser's client.

    With the query `?scene`, a small page shows the scene without its widgets.

    Parameters
    ----------
    body
        The HTML.
    name
        The title of the page.
    icon
        Its icon, as the text of an SVG file; '' for that of viser.
    small_page
        The path of the page for small screens, to which they are led except by the query `?full`;
        '' if there is none.
    is_packed
        Whether the HTML is compressed with gzip, as is the returned one then.

    """
    text = gzip.decompress(body) if is_packed else body
    # '<' would allow the path to end the script.
    script = SCRIPT % (json.dumps(small_page).replace('<', '\\u003c'), SMALL)
    head = f'<style>{web_file("viser.css")}</style><script>{web_file("card.js")}</script>{script}'
    text = text.replace(TITLE, f'<title>{escape(name)}</title>{head}'.encode(), 1)
    if icon:
        data = f'data:image/svg+xml,{quote(icon)}'.encode()
        text = ICON.sub(lambda found: found[1] + data + b'"', text, count=1)
    return gzip.compress(text, 6) if is_packed else text
