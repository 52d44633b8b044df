# SPDX-License-Identifier: Apache-2.0
"""The embedded pages, as far as they are the same."""

from __future__ import annotations

from pathlib import Path
import re

import pytest
import robot_console
from robot_console.page_text import page_text
from rviz_common.page.web_files import web_file

WEB = Path(robot_console.__file__).parent / 'web'
PAGES = {each.stem for each in WEB.glob('*.html') if '<html' in each.read_text(encoding='utf-8')}
OUTSIDE = '--mantine-'
"""What the colors of the page around begin with."""


@pytest.mark.parametrize('name', sorted(PAGES))
def test_each_page_has_both_themes(name: str) -> None:
    """All its colors are those of the theme, which it includes."""
    text = page_text(name, {})
    used = {each for each in re.findall(r'var\((--[\w-]+)', text) if not each.startswith(OUTSIDE)}
    assert '--back' in used and 'data-mantine-color-scheme' in text
    assert used <= set(re.findall(r'(--[\w-]+):', text))
    assert not re.search('#[0-9a-f]{6}', text.replace(web_file('theme.css'), ''))
