# SPDX-License-Identifier: Apache-2.0
"""Several panels at once in a browser."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
import sys
from typing import Any

import pytest
from rviz_common.page import Page
from rviz_common.panels.panel_tabs import TO_LEFT, TO_TABS
from rviz_common.visualizer import Visualizer

sys.path.append(str(Path(__file__).parents[3] / 'test'))

from browser import chromium  # noqa: E402

WIDTH = 1000
FILE = """
Panels:
  - {Class: rviz_common/Views, Name: Views}
  - {Class: rviz_common/Time, Name: Time}
  - {Class: rviz_common/Tool Properties, Name: Tools}
"""


@pytest.fixture
def browser() -> Iterator[Any]:
    """Start a browser."""
    with chromium() as browser:
        yield browser


def test_panels_are_docked_and_come_back(
    page: Page, show: Callable[..., Visualizer], spin_until: Any, browser: Any
) -> None:
    """Two are on the left, one above the other, beside a tab; what is in them moves along."""
    shown = show(FILE)
    tab = browser.new_page(viewport={'width': WIDTH, 'height': 700})
    failures: list[str] = []
    tab.on('pageerror', lambda error: failures.append(str(error)))
    tab.goto(f'http://127.0.0.1:{page.port}/?fixedDpr=0.2', wait_until='commit')
    to_left = tab.get_by_role('button', name=TO_LEFT[0])
    to_tabs = tab.get_by_role('button', name=TO_TABS[0])
    views = tab.get_by_role('button', name='Take this view')
    for name in ('Views', 'Time'):
        spin_until(tab.get_by_role('tab', name=name).is_visible, f'the tab {name}')
        tab.get_by_role('tab', name=name).click()
        spin_until(to_left.is_visible, 'a button')
        to_left.click()
        panel = next(each for each in shown.panels.panels if each.name == name)
        spin_until(lambda panel=panel: panel.is_docked, f'{name} is docked')
    spin_until(lambda: to_tabs.count() == 2, 'two panels')
    spin_until(lambda: views.is_visible() and to_left.is_visible(), 'three panels in sight')
    boxes = [each.bounding_box() for each in (to_tabs.first, to_tabs.last, to_left)]
    assert all(boxes)
    above, below, right = boxes
    assert above['x'] < WIDTH / 2 and below['x'] < WIDTH / 2 < right['x']
    assert above['y'] + 100 < below['y']
    to_tabs.first.click()
    spin_until(lambda: to_tabs.count() == 1, 'one panel on the left')
    spin_until(tab.get_by_role('tab', name='Views').is_visible, 'the tab again')
    tab.get_by_role('tab', name='Views').click()
    spin_until(views.is_visible, 'what is in it')
    assert views.bounding_box()['x'] > WIDTH / 2
    assert [each.name for each in shown.panels.panels if each.is_docked] == ['Time']
    tab.reload(wait_until='commit')
    spin_until(lambda: to_tabs.count() == 1 and to_tabs.is_visible(), 'a docked panel, again')
    assert to_tabs.bounding_box()['x'] < WIDTH / 2
    assert failures == []


def test_small_screens_have_no_dock(
    page: Page, show: Callable[..., Visualizer], spin_until: Any, browser: Any
) -> None:
    """They offer none; what is docked elsewhere is a section below the tabs."""
    show(FILE.replace('Name: Time', 'Name: Time, Docked: true'))
    tab = browser.new_page(viewport={'width': 390, 'height': 844})
    tab.goto(f'http://127.0.0.1:{page.port}/?fixedDpr=0.2', wait_until='commit')
    spin_until(tab.get_by_role('tab', name='Views').is_visible, 'a tab')
    section = tab.get_by_role('button', name='Expand panel Time')
    spin_until(section.is_visible, 'a section')
    for name in (TO_LEFT[0], TO_TABS[0]):
        assert not tab.get_by_role('button', name=name).first.is_visible()
