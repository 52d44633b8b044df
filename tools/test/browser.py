# SPDX-License-Identifier: Apache-2.0
"""
A browser without a window, and what is in the pages of viser.

The scene is asked for by `window.__viserMutable`, which viser keeps for its own tests: what is
known about it is known here only.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
import os
from pathlib import Path
import re
from typing import Any
from urllib.parse import urlsplit
from weakref import WeakSet

from programs import wait_until
import pytest

__all__ = ['Browser', 'Tab', 'browser_started', 'chromium', 'texts_of_pages']

CHROMIUM = '/usr/bin/chromium'
# Two of these are for machines without a graphics card, one for those without user namespaces.
ARGUMENTS = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--no-sandbox']
RARE_FRAMES = """
    window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 90);
    window.cancelAnimationFrame = clearTimeout;
"""
"""Lets a page draw ten frames a second: without a graphics card, drawing needs processors."""
PAGES: WeakSet[Any] = WeakSet()
"""The pages that tests have opened."""
SIZE = {'width': 900, 'height': 620}
PATIENCE_S = 100.0
PICTURES = Path(__file__).resolve().parents[2] / 'build' / 'pictures'

NODE = """
    const node = (link) => {
      const nodes = window.__viserMutable?.nodeRefFromName ?? {};
      const names = Object.keys(nodes).filter((each) => each.endsWith(`/${link}`) && nodes[each]);
      names.sort((one, other) => one.localeCompare(other, undefined, { numeric: true }));
      return nodes[names[0]]; // the robot: the display of its commands comes after it
    };
"""
POSE = (
    '(link) => {'
    + NODE
    + """
      const found = node(link);
      if (!found) return null;
      for (let each = found; each; each = each.parent) if (!each.visible) return null;
      const { w, x, y, z } = found.quaternion;
      return [w, x, y, z, ...found.position.toArray()];
    }"""
)


@dataclass(frozen=True)
class Place:
    """Where a link is in the scene, in its parent."""

    wxyz: tuple[float, ...]
    xyz: tuple[float, ...]

    def is_near(self, other: Place, tolerance: float = 1e-3) -> bool:
        """Tell whether both are the same place, whose rotation has two quaternions."""
        along = sum(a * b for a, b in zip(self.wxyz, other.wxyz))
        apart = max(abs(a - b) for a, b in zip(self.xyz, other.xyz))
        return abs(along) > 1.0 - tolerance**2 / 2.0 and apart < tolerance


class Tab:
    """A page that is open, with all that it asks for."""

    def __init__(self, page: Any, url: str) -> None:
        """Open an address, and wait for the scene."""
        self.page = page
        self.url = url
        self.requests: list[str] = []
        self.failures: list[str] = []
        page.set_default_timeout(PATIENCE_S * 1000.0)
        page.on('request', lambda request: self.requests.append(request.url))
        page.on('websocket', lambda socket: self.requests.append(socket.url))
        page.on('pageerror', lambda error: self.failures.append(str(error)))
        query = '&' if '?' in url else '?'
        page.goto(f'{url}{query}fixedDpr=0.5')
        page.wait_for_function('() => window.__viserMutable')

    @property
    def elsewhere(self) -> list[str]:
        """Return what was asked for that is not of the page itself."""
        own = {urlsplit(self.url).netloc, ''}  # nothing is asked for of blob: and data:
        return [each for each in self.requests if urlsplit(each).netloc not in own]

    def place(self, link: str) -> Place | None:
        """Return where a link of the robot is in its parent, or None if it is not shown."""
        found = self.page.evaluate(POSE, link)
        return Place(tuple(found[:4]), tuple(found[4:])) if found else None

    def wait_for_link(self, link: str) -> None:
        """Wait until a link of the robot is shown."""
        wait_until(lambda: self.place(link), PATIENCE_S, lambda: f'the link {link} in the scene')

    def wait_for_motion(self, link: str, tolerance: float = 0.02) -> None:
        """Wait until a link moves in its parent."""
        self.wait_for_link(link)
        seen: list[Place] = []

        def moves() -> bool:
            now = self.place(link)
            seen.extend([now] if now else [])
            return not all(each.is_near(seen[0], tolerance) for each in seen[-1:])

        wait_until(moves, PATIENCE_S, lambda: f'the link {link} to move in {self.text()}')

    def text(self) -> str:
        """Return what the page says, not too much of it."""
        return repr(self.page.inner_text('body')[:2000])

    def box(self, label: str) -> Any:
        """Return the field for text or numbers whose label begins with a text."""
        labels = self.page.locator('label').filter(has_text=re.compile(f'^{re.escape(label)}'))
        row = labels.filter(visible=True).first.locator(
            'xpath=ancestor::*[contains(@class, "Flex-root")][1]'
        )
        return row.locator('input:not([type=hidden])').first

    def tick(self, label: str) -> None:
        """Tick a checkbox; the page may only show it some frames after the click."""
        self.box(label).click()
        wait_until(self.box(label).is_checked, PATIENCE_S, lambda: f'{label} to be ticked')

    def button(self, name: str) -> Any:
        """Return a button."""
        return self.page.get_by_role('button', name=name, exact=True)

    def show(self, name: str) -> None:
        """Turn to a tab of the panels."""
        self.page.get_by_role('tab', name=name, exact=True).click()

    def small(self, title: str) -> Any:
        """Return a small page inside of the page."""
        return self.page.frame_locator(f'iframe[title={title}]')

    def picture(self, name: str) -> Path:
        """Keep what is seen, without what viser says about machines without a graphics card."""
        for button in self.page.locator('.mantine-Notification-closeButton').all():
            button.click()
        wait_until(lambda: not self.page.locator('.mantine-Notification-root').count(), 20.0, '')
        path = PICTURES / f'{name}.png'
        self.page.screenshot(path=path, timeout=PATIENCE_S * 1000.0)
        return path


class Browser:
    """A browser, of which all is thrown away in the end."""

    def __init__(self, browser: Any) -> None:
        """Take what playwright has started."""
        self._browser = browser

    def open(self, url: str, size: dict[str, int] = SIZE) -> Tab:
        """Open a page of viser."""
        return Tab(self._browser.new_page(viewport=size, reduced_motion='reduce'), url)

    def pid(self) -> int:
        """Return the id of the process that all others of the browser belong to."""
        found = self._browser.new_browser_cdp_session().send('SystemInfo.getProcessInfo')
        return next(each['id'] for each in found['processInfo'] if each['type'] == 'browser')


@contextmanager
def browser_started() -> Iterator[Browser]:
    """Start a browser; where there is none, the test is left out."""
    with chromium() as browser:
        PICTURES.mkdir(parents=True, exist_ok=True)
        yield Browser(browser)


@contextmanager
def chromium(*, draws_all: bool = False) -> Iterator[Any]:
    """
    Start a browser of playwright; where there is none, the test is left out.

    Its pages draw no more frames than tests need, unless they are to draw all.
    """
    api = pytest.importorskip('playwright.sync_api')
    if not os.path.exists(CHROMIUM):
        pytest.skip(f'needs a browser: there is no {CHROMIUM}')
    with api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=ARGUMENTS)
        if not draws_all:
            browser.new_page = _calm(browser.new_page)
            browser.new_context = _calm(browser.new_context)
        yield browser
        browser.close()


def _calm(opened: Callable[..., Any]) -> Callable[..., Any]:
    """Return what opens a page or a context as before, in which frames are rare."""

    def open_calm(**options: Any) -> Any:
        page = opened(**options)
        page.add_init_script(RARE_FRAMES)
        PAGES.add(page)
        return page

    return open_calm


def texts_of_pages() -> list[tuple[str, str]]:
    """Return the addresses of the pages that are open, and what each says."""
    from playwright.sync_api import Error

    texts = []
    for page in (page for each in PAGES for page in getattr(each, 'pages', [each])):
        with suppress(Error):  # it has just closed, or does not answer
            texts.append((page.url, page.inner_text('body', timeout=5000.0)))
    return texts
