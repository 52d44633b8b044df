# SPDX-License-Identifier: Apache-2.0
"""Does what the shorter pages of the documentation say; `story_docs.py` does the others."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
import re
import shutil
import subprocess
import sys
from typing import Any

from docs_reader import do_page, DOCS, LONG, PAGES
import pytest

BUILDS_HERE = ('workspace',)
RUNS = [
    pytest.param(page, id=page.stem, marks=[pytest.mark.alone] * (page.stem in BUILDS_HERE))
    for page in PAGES
    if page.stem not in LONG
]


@pytest.mark.timeout(600)
@pytest.mark.parametrize('page', RUNS)
def test_a_page_works_as_written(
    page: Path, root: Path, tmp_path: Path, start: Callable[..., Any], own_domain: int
) -> None:
    """Everything that the page tells its reader to do works, and prints what it says."""
    do_page(page, root, tmp_path, start)


@pytest.mark.parametrize('page', PAGES, ids=lambda page: page.stem)
def test_the_folder_is_named_before_it_is_used(page: Path) -> None:
    """A page whose commands use $HUMANOID says before them what to set it to."""
    before, used, _ = page.read_text().partition('"$HUMANOID')
    assert not used or 'export HUMANOID=' in before


def test_links_lead_somewhere() -> None:
    """Every relative link of the documentation and the READMEs names a file that exists."""
    pages = [*DOCS.rglob('*.md'), *DOCS.parent.glob('*.md'), *DOCS.parent.glob('src/*/*.md')]
    broken = [
        f'{page}: {target}'
        for page in pages
        for target in re.findall(r'\]\(([^)#:]+)(?:#[^)]*)?\)', page.read_text())
        if not (page.parent / target).exists()
    ]
    assert broken == []


@pytest.mark.skipif(not shutil.which('systemd-analyze'), reason='there is no systemd here')
def test_the_service_is_valid(tmp_path: Path) -> None:
    """Systemd has nothing to say about the unit file that starts the robot."""
    page = (DOCS / 'how-to' / 'robot_and_laptop.md').read_text()
    [unit] = re.findall(r'^```ini file=~/(\S+)\n(.*?)^```$', page, re.MULTILINE | re.DOTALL)
    program = '/home/robot/humanoid/tools/ros2'  # which is not here
    assert f'ExecStart={program} launch' in unit[1]
    path = tmp_path / unit[0]
    path.write_text(unit[1].replace(program, sys.executable))
    done = subprocess.run(['systemd-analyze', 'verify', path], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, '')


def test_pictures_are_small_and_shown() -> None:
    """Each picture is shown by a page, and none is large."""
    pages = [*DOCS.rglob('*.md'), DOCS.parent / 'README.md']
    text = ''.join(page.read_text() for page in pages)
    pictures = [*DOCS.glob('pictures/*')]
    assert [each for each in pictures if f'pictures/{each.name})' not in text] == []
    sizes = {each.name: each.stat().st_size for each in pictures}
    assert sizes.pop('command.webp') <= 900_000
    assert [name for name, size in sizes.items() if size > 150_000] == []


def test_each_picture_is_taken_by_a_tour() -> None:
    """`make pictures` takes every picture anew."""
    tours = (DOCS.parent / 'tools' / 'pictures').glob('*.py')
    taken = re.findall(r"'(\w+\.(?:png|webp))'", ''.join(each.read_text() for each in tours))
    assert {each.name for each in DOCS.glob('pictures/*')} <= set(taken)
