# SPDX-License-Identifier: Apache-2.0
"""Fixtures: a workspace with packages in it."""

from collections.abc import Callable
from pathlib import Path

import pytest

SETUP_PY = """\
from setuptools import setup
package_name = '{name}'
setup(name=package_name, data_files=[{data_files}], {entry_points})
"""


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Make a workspace the current folder, with an environment that knows nothing of it."""
    folder = tmp_path / 'my ws'
    (folder / 'src').mkdir(parents=True)
    other = tmp_path / 'ros'
    other.mkdir()
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(other))
    monkeypatch.delenv('COLCON_PREFIX_PATH', raising=False)
    monkeypatch.chdir(folder)
    return folder


@pytest.fixture
def make_package(workspace: Path) -> Callable[..., Path]:
    """Return a function that makes a Python package in the source tree."""

    def make(
        name: str,
        *,
        below: str = 'src',
        data_files: str = '',
        entry_points: str = "entry_points={'console_scripts': []}",
    ) -> Path:
        folder = workspace / below / name
        (folder / name).mkdir(parents=True)
        (folder / name / '__init__.py').touch()
        (folder / 'package.xml').write_text(f'<package><name>{name}</name></package>')
        (folder / 'setup.py').write_text(
            SETUP_PY.format(name=name, data_files=data_files, entry_points=entry_points)
        )
        return folder

    return make
