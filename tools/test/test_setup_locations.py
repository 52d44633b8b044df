# SPDX-License-Identifier: Apache-2.0
"""Tests of where the environment lies."""

from __future__ import annotations

from pathlib import Path

from console import SetupError
from locations import find_locations, link_environment
import pytest


@pytest.fixture(autouse=True)
def cache(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """Keep the cache of the test in its folder."""
    monkeypatch.setenv('XDG_CACHE_HOME', str(tmp_path / 'cache'))
    return tmp_path / 'cache'


def test_it_lies_in_the_workspace() -> None:
    """A plain path holds its own environment."""
    locations = find_locations(Path('/home/ann/ws'), None)
    assert locations.environment == locations.link == Path('/home/ann/ws/.venv')


@pytest.mark.parametrize('root', ['/home/ann/my robots', '/home/' + 'long/' * 30 + 'ws'])
def test_it_lies_in_the_cache_where_scripts_could_not_name_it(root: str, cache: Path) -> None:
    """A space or a very long path: .venv leads to a folder in the cache."""
    locations = find_locations(Path(root), None)
    assert locations.environment.parent == cache / 'humanoid-workspace'
    assert locations.link == Path(root) / '.venv'
    assert find_locations(Path(root + '2'), None).environment != locations.environment


def test_a_named_environment_is_linked(tmp_path: Path) -> None:
    """VENV= keeps it elsewhere, and a later run without VENV= finds it there."""
    root, other = tmp_path / 'ws', tmp_path / 'other'
    root.mkdir()
    locations = find_locations(root, str(other))
    assert locations.environment == other
    link_environment(locations)
    assert find_locations(root, None).environment == other


def test_a_named_environment_does_not_replace_a_real_one(tmp_path: Path) -> None:
    """An environment in .venv is not pushed aside."""
    (tmp_path / '.venv').mkdir()
    with pytest.raises(SetupError, match='make distclean'):
        find_locations(tmp_path, str(tmp_path / 'other'))


def test_a_home_folder_that_does_not_exist(tmp_path: Path) -> None:
    """It is named, and nothing is made beside the workspace."""
    with pytest.raises(SetupError, match="There is no home folder '~no_one': give the whole path"):
        find_locations(tmp_path, '~no_one/venv')


def test_a_named_environment_with_a_space_is_refused(tmp_path: Path) -> None:
    """Scripts could not start from there."""
    with pytest.raises(SetupError, match='VENV='):
        find_locations(tmp_path, '/with a space/venv')
