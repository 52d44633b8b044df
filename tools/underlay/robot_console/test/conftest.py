# SPDX-License-Identifier: Apache-2.0
"""A browser, and patient pages; what the tests of this package share can be imported."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
import sys
from typing import Any
from unittest import mock

import pytest
from robot_console import control_page, phone_page, small_page
from robot_console.page_text import page_text

sys.path.insert(0, str(Path(__file__).parent))
sys.path.append(str(Path(__file__).parents[3] / 'test'))

from browser import chromium  # noqa: E402

OWN = ('http://127.0.0.1:', 'ws://127.0.0.1:', 'blob:', 'data:', 'about:')


@pytest.fixture(scope='module')
def browser() -> Iterator[Any]:
    """Start a browser, if there is one."""
    with chromium() as browser:
        yield browser


@pytest.fixture
def open_tab(browser: Any) -> Iterator[Callable[..., Any]]:
    """Return what opens a tab, in which no script may fail, and that asks nobody else."""
    tabs: list[Any] = []
    failures: list[str] = []

    def note(url: str) -> None:
        if not url.startswith(OWN):
            failures.append(url)

    def open_one(width: int, height: int, **options: Any) -> Any:
        tab = browser.new_page(viewport={'width': width, 'height': height}, **options)
        tabs.append(tab)
        tab.on('pageerror', lambda error: failures.append(str(error)))
        tab.on('request', lambda request: note(request.url))
        return tab

    yield open_one
    for tab in tabs:
        tab.close()
    assert failures == []


@pytest.fixture
def patience() -> Iterator[None]:
    """
    Let pages be silent for long, as they are on a machine that runs many tests at once.

    Else a robot that is driven is stopped, which is right, but not what is looked at here.
    """
    limits = ('LOST_MS = 800', 'this.heardAt > 3000')

    def patient_text(name: str, settings: dict[str, Any], package: str = 'robot_console') -> str:
        text = page_text(name, settings, package)
        for limit in limits if 'class Link' in text else ():
            assert limit in text
            text = text.replace(limit, f'{limit}000')
        return text

    with (
        mock.patch.object(control_page, 'SILENCE_S', 100.0),
        mock.patch.object(small_page, 'page_text', patient_text),
        mock.patch.object(phone_page, 'page_text', patient_text),
    ):
        yield
