# SPDX-License-Identifier: Apache-2.0
"""Tests of packages whose setup.py names files that do not exist."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import pytest
from ros_environment.missing_data_files import leave_out, split


@pytest.fixture(autouse=True)
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Stand in a package with one file."""
    (tmp_path / 'here.yaml').touch()
    monkeypatch.chdir(tmp_path)


def test_what_exists_is_kept() -> None:
    """Pairs and plain names keep the files that are there, in order."""
    kept, missing = split([('share/p', ['here.yaml', 'a.yaml']), 'here.yaml', 'b.yaml'])
    assert kept == [('share/p', ['here.yaml']), 'here.yaml']
    assert missing == ['a.yaml', 'b.yaml']


def test_an_installation_says_what_is_missing(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Only the command that installs speaks, so that it is said once."""
    for arguments, spoken in ((['setup.py', 'egg_info'], False), (['setup.py', 'install'], True)):
        monkeypatch.setattr('sys.argv', arguments)
        distribution = SimpleNamespace(data_files=[('share/p', ['urdf/arm.urdf'])])
        leave_out(distribution)
        assert distribution.data_files == [('share/p', [])]
        assert ('urdf/arm.urdf' in capsys.readouterr().err) is spoken


def test_a_complete_package_is_not_touched(capsys: pytest.CaptureFixture[str]) -> None:
    """Nothing is said or changed where nothing is missing."""
    files = [('share/p', ['here.yaml'])]
    distribution = SimpleNamespace(data_files=files)
    leave_out(distribution)
    assert distribution.data_files is files
    assert capsys.readouterr().err == ''
