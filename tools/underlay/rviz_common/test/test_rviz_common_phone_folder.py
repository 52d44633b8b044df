# SPDX-License-Identifier: Apache-2.0
"""Tests of the QR code of the page."""

from __future__ import annotations

import re
from types import SimpleNamespace
from typing import Any

import pytest
from rviz_common.page import Page
from rviz_common.panels.phone_folder import PhoneFolder

URL = 'http://192.0.2.2:8080/?token=blzKN63zCSvi6rk7odk9_g'
MODULE = 4
"""The size of a drawn module, in pixels."""


def widgets(page: Page, monkeypatch: pytest.MonkeyPatch, url: str) -> dict[str, Any]:
    """Return the widgets of the folder of a page that others reach at an address."""
    added: dict[str, Any] = {}
    gui = page.viser.gui
    for kind in ('add_html', 'add_markdown'):
        monkeypatch.setattr(gui, kind, lambda text, kind=kind: added.update({kind: text}))
    context: Any = SimpleNamespace(gui=gui, page=SimpleNamespace(shared_url=url))
    PhoneFolder(context).close()
    return added


def test_code_can_be_read(page: Page, monkeypatch: pytest.MonkeyPatch) -> None:
    """A decoder finds the address in what is drawn; in words, the token is not repeated."""
    cv2 = pytest.importorskip('cv2')
    import numpy as np

    added = widgets(page, monkeypatch, URL)
    image = np.kron(drawn(added['add_html']), np.ones((MODULE, MODULE), np.uint8))
    assert cv2.QRCodeDetector().detectAndDecode(image)[0] == URL
    assert 'http://192.0.2.2:8080' in added['add_markdown'] and 'token' not in str(added)


def drawn(svg: str) -> Any:
    """Return the pixels of an SVG whose path has horizontal lines only."""
    import numpy as np

    size = int(re.findall(r'viewBox="0 0 (\d+) ', svg)[0])
    pixels = np.full((size, size), 255, np.uint8)
    x = y = 0.0
    for step, numbers in re.findall(r'([Mmh])([-\d. ]+)', re.findall(r' d="([^"]+)"', svg)[0]):
        first, *second = map(float, numbers.split())
        if step == 'h':
            pixels[int(y), int(x) : int(x + first)] = 0
            x += first
        else:
            x, y = (first, *second) if step == 'M' else (x + first, y + second[0])
    return pixels


def test_there_is_no_code_for_this_machine_only(
    page: Page, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where no phone reaches the page, there is no folder."""
    assert widgets(page, monkeypatch, '') == {}
