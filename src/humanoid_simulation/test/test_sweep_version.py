# SPDX-License-Identifier: Apache-2.0
"""Check which changes of the code make another version."""

from __future__ import annotations

from pathlib import Path

from humanoid_simulation.sweep import version
import pytest

FILES = ('__init__.py', 'gait.py', 'sweep/walk.py', 'sweep/report.py', 'notes.txt')


@pytest.fixture(name='package')
def _package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Let the version be that of a package of its own."""
    package = tmp_path / 'package_of_a_walk'
    (package / 'sweep').mkdir(parents=True)
    for name in FILES:
        (package / name).touch()
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(version, 'PACKAGES', (package.name,))
    monkeypatch.setattr(version, '_DATA', {})
    return package


@pytest.mark.parametrize(
    ('name', 'counts'), [(name, name not in ('sweep/report.py', 'notes.txt')) for name in FILES]
)
def test_what_counts(package: Path, name: str, counts: bool) -> None:
    """What can change a walk counts, and nothing else."""
    before = version.code_version()
    assert version.code_version() == before
    (package / name).write_text('changed = True\n')
    assert (version.code_version() != before) == counts


def test_a_new_file_and_a_new_library_count(
    package: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """So does another version of NumPy."""
    versions = {version.code_version()}
    (package / 'new.py').touch()
    versions.add(version.code_version())
    monkeypatch.setattr(version.metadata, 'version', lambda name: f'{name} 99')
    versions.add(version.code_version())
    assert len(versions) == 3


def test_the_real_one() -> None:
    """It has files of every package, and of the model."""
    packages = {name.partition('/')[0] for name, _ in version._files()}
    assert packages == {*version.PACKAGES}
    names = {name for name, _ in version._files()}
    assert 'humanoid_description/urdf/humanoid.urdf.xacro' in names
    assert 'humanoid_simulation/sweep/walk.py' in names
    assert 'humanoid_simulation/sweep/report.py' not in names
