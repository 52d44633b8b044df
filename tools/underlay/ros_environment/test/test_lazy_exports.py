# SPDX-License-Identifier: Apache-2.0
"""Tests of packages that import their public names lazily."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
import sys
from types import ModuleType

import pytest
from ros_environment.lazy import snake_case

PACKAGE = """\
from ros_environment.lazy import lazy_exports

__getattr__, __dir__ = lazy_exports(__name__, ['LeftArm', 'reach'], {'reach': '_reaching'})
"""


@pytest.fixture
def robot(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[ModuleType]:
    """Return a package with a name in the module of its own, and one elsewhere."""
    folder = tmp_path / 'lazy_robot'
    folder.mkdir()
    (folder / '__init__.py').write_text(PACKAGE)
    (folder / 'left_arm.py').write_text('class LeftArm: ...\n')
    (folder / '_reaching.py').write_text('def reach(): ...\n')
    monkeypatch.syspath_prepend(tmp_path)
    yield import_module('lazy_robot')
    for name in [name for name in sys.modules if name.startswith('lazy_robot')]:
        del sys.modules[name]


def test_a_name_is_imported_when_it_is_used(robot: ModuleType) -> None:
    """It comes from the module of its name, or from the one that is given."""
    assert 'lazy_robot.left_arm' not in sys.modules
    assert robot.LeftArm is sys.modules['lazy_robot.left_arm'].LeftArm
    assert 'lazy_robot._reaching' not in sys.modules
    assert robot.reach.__module__ == 'lazy_robot._reaching'
    assert dir(robot) == ['LeftArm', 'reach']


def test_a_misspelt_name_is_answered_with_the_closest_one(robot: ModuleType) -> None:
    """As Python does for a name in a module that is not lazy."""
    with pytest.raises(AttributeError, match=r"no attribute 'LeftArn'\. Did you mean: 'LeftArm'"):
        _ = robot.LeftArn


@pytest.mark.parametrize(
    'name, module',
    [('LogInfo', 'log_info'), ('SetROSLogDir', 'set_ros_log_dir'), ('Command', 'command')],
)
def test_snake_case(name: str, module: str) -> None:
    """A run of capitals counts as one word."""
    assert snake_case(name) == module
