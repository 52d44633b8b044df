# SPDX-License-Identifier: Apache-2.0
"""Installed files that are older than their source."""

from __future__ import annotations

import os
from pathlib import Path
import time

import pytest
from ros_environment.source_tree import StaleFiles


def _file(path: Path, text: str, age_s: float) -> str:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    moment = time.time() - age_s
    os.utime(path, (moment, moment))
    return str(path)


@pytest.mark.parametrize('layout', ['install/arm', 'install'])
@pytest.mark.parametrize('place', ['src/arm', 'src/robots/arm', 'src/a/b/folder'])
def test_newer_source(tmp_path: Path, layout: str, place: str) -> None:
    """The source is found in both layouts, wherever the package lies."""
    _file(tmp_path / place / 'package.xml', '<package><name>arm</name></package>', 0)
    source = _file(tmp_path / place / 'launch/x.launch.py', 'new', 10)
    installed = _file(tmp_path / layout / 'share/arm/launch/x.launch.py', 'old', 20)
    assert StaleFiles().newer_source(installed) == source


@pytest.mark.parametrize(
    'text, age_s', [('old', 10), ('new', 30)], ids=['same content', 'older source']
)
def test_nothing_to_say(tmp_path: Path, text: str, age_s: float) -> None:
    """A source that was only touched, or that is older, is fine."""
    _file(tmp_path / 'src/arm/package.xml', '<package><name>arm</name></package>', 0)
    _file(tmp_path / 'src/arm/x.yaml', text, age_s)
    installed = _file(tmp_path / 'install/arm/share/arm/x.yaml', 'old', 20)
    assert StaleFiles().newer_source(installed) == ''


def test_symbolic_link_is_never_stale(tmp_path: Path) -> None:
    """With --symlink-install the installed file is the source."""
    _file(tmp_path / 'src/arm/package.xml', '<package><name>arm</name></package>', 0)
    source = _file(tmp_path / 'src/arm/x.yaml', 'new', 0)
    link = tmp_path / 'install/arm/share/arm/x.yaml'
    link.parent.mkdir(parents=True)
    link.symlink_to(source)
    assert StaleFiles().newer_source(str(link)) == ''


@pytest.mark.parametrize('path', ['/no/share/arm/x.yaml', '/x.yaml', '/a/share/arm'])
def test_what_is_in_no_workspace(path: str) -> None:
    """Other files have no source."""
    assert StaleFiles().newer_source(path) == ''
