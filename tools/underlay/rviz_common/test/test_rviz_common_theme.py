# SPDX-License-Identifier: Apache-2.0
"""The themes of the page: which one it is, and that all of it can be read."""

from __future__ import annotations

import re

import pytest
from rviz_common.page.web_files import filled, frame_text, web_file
from rviz_common.visualizer.viewers import is_dark_theme

TEXTS = {
    'text': 'back list button button-hover field hover tile chip chosen lost',
    'dim': 'back list field hover tile chosen lost',
    'good': 'back list',
    'warn': 'back list chosen',
    'bad': 'back list chosen',
    'name': 'list hover',
    'on': 'blue blue-hover green green-hover red red-hover ochre '
    'stop stop-hover stopped dead real simulated slow',
}
"""The names of colors of texts, and of those that they are written on."""
READABLE, VISIBLE = 4.5, 3.0
"""The contrasts that WCAG 2.1 requires at the level AA: of texts, and of edges of fields."""


def colors_of(theme: int) -> dict[str, str]:
    """Return the colors of the light theme (0) or the dark one (1) by name."""
    named = re.findall(r'--([\w-]+): ([^;]+);', web_file('theme.css'))
    return {name: (re.findall('#[0-9a-f]{6}', value) * 2)[theme] for name, value in named}


def luminance(color: str) -> float:
    """Return the relative luminance of a color, as WCAG defines it."""
    parts = (int(color[start : start + 2], 16) / 255.0 for start in (1, 3, 5))
    red, green, blue = (p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one: str, other: str) -> float:
    """Return the contrast of two colors, from 1 to 21."""
    dark, bright = sorted((luminance(one), luminance(other)))
    return (bright + 0.05) / (dark + 0.05)


def test_the_contrast_is_that_of_wcag() -> None:
    """Black on white has most; the grey is the darkest that is too bright on white."""
    assert contrast('#000000', '#ffffff') == pytest.approx(21.0)
    assert contrast('#767676', '#ffffff') > 4.5 > contrast('#777777', '#ffffff')


@pytest.mark.parametrize('theme', [0, 1], ids=['light', 'dark'])
def test_all_texts_can_be_read(theme: int) -> None:
    """Each on everything that it is written on."""
    colors = colors_of(theme)
    found = {
        (text, back): round(contrast(colors[text], colors[back]), 2)
        for text, backs in TEXTS.items()
        for back in backs.split()
    }
    assert {pair: each for pair, each in found.items() if each < READABLE} == {}
    assert min(contrast(colors['edge'], colors[each]) for each in ('back', 'field')) > VISIBLE


@pytest.mark.parametrize(
    ('choice', 'of_file', 'system', 'is_dark'),
    [
        ('light', 'Dark', 'dark', False),
        ('dark', 'Light', 'light', True),
        ('', 'Dark', 'light', True),
        ('', 'Light', 'dark', False),
        ('', 'Browser', 'light', False),
        ('', 'Browser', 'dark', True),
        ('', 'Browser', '', True),
    ],
)
def test_the_user_decides_then_the_file_then_the_system(
    choice: str, of_file: str, system: str, is_dark: bool
) -> None:
    """If none of them does, it is dark."""
    assert is_dark_theme(choice, of_file, system) is is_dark


def test_an_embedded_page_has_the_theme() -> None:
    """It is filled in where the page wants it, as are settings, which cannot end the script."""
    text = filled('/* theme.css */ /* theme.js */ /* settings */ {}', {'a': '</script>'})
    assert '--back:' in text and 'data-mantine-color-scheme' in text
    assert '{"a": "\\u003c/script>"}' in text


def test_a_frame_can_be_told_something() -> None:
    """Beside its path, which may have any characters."""
    assert 'src="/look%20at%23#3"' in frame_text('/look at#', 'look', '3')
    assert 'src="/look"' in frame_text('/look', 'look')
