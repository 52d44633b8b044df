# SPDX-License-Identifier: Apache-2.0
"""How the page looks in a browser."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
import sys
from typing import Any

import pytest
from rviz_common.page import Page
from rviz_common.visualizer import quality, Visualizer
from rviz_common.visualizer.surroundings import EVEN_LIGHT, SHADOWS, SKY

sys.path.append(str(Path(__file__).parents[3] / 'test'))

from browser import chromium  # noqa: E402
from obstacles import obstacles  # noqa: E402

WITH_GROUND = 'Visualization Manager: {Global Options: {Ground and Sky: true}}'
SMOOTHED = """
    window.__viserMutable.canvas.getContext('webgl2').getContextAttributes().antialias
"""
RATIO = 'window.__viserTestpoints?.devSettings.get().fixedDpr'
SIMPLE = """(() => {
    const found = [];
    window.__viserMutable.scene.traverse(({ material }) => {
      if (material?.type === 'MeshBasicMaterial') found.push(Boolean(material.userData.isSimple));
    });
    return found;
})()"""
SCHEME = "document.documentElement.getAttribute('data-mantine-color-scheme')"


@pytest.fixture
def tab() -> Iterator[Any]:
    """Return a tab of a browser whose system prefers light, in which no script may fail."""
    with chromium() as browser:
        tab = browser.new_page(viewport={'width': 700, 'height': 500}, color_scheme='light')
        failures: list[str] = []
        tab.on('pageerror', lambda error: failures.append(str(error)))
        yield tab
        assert failures == []


def test_each_browser_has_its_own_theme(
    page: Page, show: Callable[..., Visualizer], spin_until: Any, tab: Any
) -> None:
    """It begins as the system prefers; what is chosen then is remembered, by this browser only."""
    show(WITH_GROUND)
    tab.goto(f'http://127.0.0.1:{page.port}/?fixedDpr=0.5', wait_until='commit')
    spin_until(page.viser.get_clients, 'a browser')
    (client,) = page.viser.get_clients().values()
    spin_until(lambda: client.scene.get_handle_by_name(SKY), 'a bright sky')
    spin_until(lambda: tab.evaluate(SCHEME) == 'light', 'the light theme')
    look = tab.frame_locator('iframe[title=look]')
    assert look.locator('html').get_attribute('data-theme') == 'light'
    look.locator('#theme').select_option('dark')
    spin_until(lambda: tab.evaluate(SCHEME) == 'dark', 'the dark theme')
    spin_until(lambda: look.locator('html').get_attribute('data-theme') == 'dark', 'a dark frame')
    assert client.scene.get_handle_by_name(SKY) is None
    tab.reload(wait_until='commit')
    spin_until(look.locator('#theme').is_visible, 'the choice')
    assert look.locator('#theme').input_value() == 'dark'
    spin_until(lambda: tab.evaluate(SCHEME) == 'dark', 'the dark theme again')


def test_each_browser_draws_as_much_as_it_can(
    page: Page,
    show: Callable[..., Visualizer],
    spin_until: Any,
    tab: Any,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Without a graphics card it casts no shadows, and says so, unless its user wants them."""
    monkeypatch.setattr(quality, 'SLOW_HZ', 0.0)  # nor do other tests make it slow
    show(WITH_GROUND)
    tab.goto(f'http://127.0.0.1:{page.port}/', wait_until='commit')
    look = tab.frame_locator('iframe[title=look]')
    told = look.locator('#told')
    spin_until(told.is_visible, 'a sentence')
    assert tab.evaluate(SMOOTHED) is False
    assert 'without a graphics card' in (look.locator('#sentence').text_content() or '')
    (client,) = page.viser.get_clients().values()
    assert client.scene.get_handle_by_name(SHADOWS) is None
    look.locator('#undo').click()
    spin_until(lambda: client.scene.get_handle_by_name(SHADOWS), 'shadows')
    spin_until(lambda: not told.is_visible(), 'no sentence')
    look.locator('#quality').select_option('Coarse')
    spin_until(lambda: tab.evaluate(RATIO) == 0.6, 'fewer pixels')
    assert client.scene.get_handle_by_name(EVEN_LIGHT) is not None
    spin_until(lambda: any(tab.evaluate(SIMPLE)), 'simple light')
    tab.reload(wait_until='commit')
    spin_until(look.locator('#quality').is_visible, 'the choice')
    assert look.locator('#quality').input_value() == '2'
    look.locator('#quality').select_option('Automatic')
    spin_until(lambda: told.is_visible() and tab.evaluate(RATIO) is None, 'all pixels again')
    spin_until(lambda: not any(tab.evaluate(SIMPLE)), 'no simple light')
    (frame,) = (each for each in tab.frames if '/look/' in each.url)
    assert obstacles(frame) == []
