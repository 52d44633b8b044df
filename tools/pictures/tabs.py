# SPDX-License-Identifier: Apache-2.0
"""Open pages so that they look the same on each machine, and keep pictures of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from io import BytesIO
from pathlib import Path
import re
from typing import Any

import numpy as np
from PIL import Image, ImageChops, ImageStat

__all__ = ['HEIGHT', 'WIDTH', 'Box', 'box_of', 'keep', 'opened', 'scene_box', 'seen', 'show_from']

FOLDER = Path(__file__).resolve().parents[2] / 'docs' / 'pictures'
LARGEST = 150_000
SAVED: Mapping[str, Mapping[str, Any]] = {
    '.png': {'optimize': True},
    '.webp': {'quality': 80, 'method': 6},
}
"""Options of the format, by suffix."""
WIDTH, HEIGHT = 1200, 900
PATIENCE_MS = 120_000
BEGIN_MS, SETTLE_MS = 15_000, 2000
STILL = 3.0
"""How much two pictures may differ on average, of 255: a robot moves less than that."""
ATTEMPTS = 30
SAME_EVERYWHERE = """
if (location.protocol === 'http:') {
  // The page would choose by itself how much it draws, by how fast this machine is.
  localStorage.setItem('rviz.quality', '1');
  // Few frames are enough for pictures, and leave the processor to the robot.
  const draw = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (callback) => setTimeout(() => draw(callback), 150);
  window.cancelAnimationFrame = (id) => clearTimeout(id);
}
"""

Box = tuple[int, int, int, int]
"""A part of a picture: left, top, right and bottom, in pixels."""


def opened(
    browser: Any,
    address: str,
    theme: str = 'light',
    size: tuple[int, int] = (WIDTH, HEIGHT),
    **options: Any,
) -> Any:
    """
    Open a page without the notes that only concern this browser; its errors are printed.

    Parameters
    ----------
    browser, address
        The browser of Playwright, and the URL of the page.
    theme
        What the system of the viewer prefers: `light` or `dark`.
    size
        The width and the height of the page, in pixels.
    **options
        Further options of Playwright for the page, such as `has_touch`.

    Returns
    -------
    Any
        The `Page` of Playwright.

    """
    width, height = size
    viewport = {'width': width, 'height': height}
    tab = browser.new_page(viewport=viewport, color_scheme=theme, **options)
    tab.set_default_timeout(PATIENCE_MS)
    tab.on('pageerror', lambda error: print(f'The page: {error}'))
    tab.on('console', _print_fault)
    tab.add_init_script(SAME_EVERYWHERE)
    tab.goto(f'{address}&fixedDpr=1')
    tab.wait_for_timeout(BEGIN_MS)
    for frame in tab.frames:
        for close in frame.locator('.mantine-Notification-closeButton').all():
            close.click()
    _settle(tab)
    return tab


def _settle(tab: Any) -> None:
    """Wait until a page has faded in and its view stands still, as far as a robot in it does."""
    before = None
    for _ in range(ATTEMPTS):
        tab.wait_for_timeout(SETTLE_MS)
        now = seen(tab)
        if before and np.mean(ImageStat.Stat(ImageChops.difference(before, now)).mean) < STILL:
            return
        before = now


def _print_fault(message: Any) -> None:
    """Print an error that a page writes to the console of the browser."""
    if message.type == 'error':
        print(f'The page: {message.text}')


def seen(part: Any) -> Image.Image:
    """
    Take a picture.

    Parameters
    ----------
    part
        The page, or a locator of a part of it.

    """
    return Image.open(BytesIO(part.screenshot())).convert('RGB')


def box_of(part: Any) -> Box:
    """
    Find a part of a page in the picture of the page.

    Parameters
    ----------
    part
        The locator of the part.

    """
    box = part.bounding_box()
    x, y = round(box['x']), round(box['y'])
    return x, y, x + round(box['width']), y + round(box['height'])


def scene_box(tab: Any) -> Box:
    """
    Find the scene, which is beside the panels, in the picture of the page.

    Parameters
    ----------
    tab
        The page.

    """
    return box_of(tab.locator('canvas[data-engine]'))


def show_from(tab: Any, view: Mapping[str, Sequence[str]]) -> None:
    """
    Set the view of the page.

    Parameters
    ----------
    tab
        The page.
    view
        The texts to enter, by the label of the fields; a label may have several fields.

    """
    tab.get_by_role('tab', name='Views').click()
    for label, values in view.items():
        name = tab.locator('label', has_text=re.compile(f'^{label}')).filter(visible=True).first
        row = name.locator('xpath=ancestor::*[contains(@class, "Flex-root")][1]')
        for field, value in zip(row.locator('input:not([type=hidden])').all(), values):
            field.fill(value)
            field.press('Enter')
    _settle(tab)


def keep(name: str, picture: Image.Image, largest: int = LARGEST, **options: Any) -> None:
    """
    Write a picture to its file.

    Parameters
    ----------
    name
        The name of the file in `FOLDER`, with its suffix.
    picture
        The picture, or the first frame of an animation.
    largest
        How many bytes the file may have.
    **options
        Options for `Image.save`, beside those of `SAVED`.

    Raises
    ------
    SystemExit
        The file is larger.

    """
    path = FOLDER / name
    picture.save(path, **{**SAVED[path.suffix], **options})
    size = path.stat().st_size
    print(f'{path}  {size // 1000} kB')
    if size > largest:
        raise SystemExit(f'{path.name} has more than {largest // 1000} kB: choose less to show.')
