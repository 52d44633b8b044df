# SPDX-License-Identifier: Apache-2.0
"""Tests of the folder of wheels for machines without internet."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import commands
from console import SetupError
import mirror
from packaging.requirements import Requirement
import pytest

REQUIREMENTS = """\
# A comment
numpy==2.2.6 ; python_full_version < '3.11'
numpy==2.4.6 ; python_full_version == '3.11.*'
numpy==2.5.5 ; python_full_version >= '3.12'
wheel==1.0

wheel==1.0
"""


@pytest.mark.parametrize(
    ('version', 'numpy'), [('3.10', '2.2.6'), ('3.11', '2.4.6'), ('3.13', '2.5.5')]
)
def test_pins_of_a_version(version: str, numpy: str) -> None:
    """Each version of Python has its pins, each once."""
    assert mirror.pins_for(REQUIREMENTS, version) == [f'numpy=={numpy}', 'wheel==1.0']


@pytest.mark.parametrize('version', mirror.VERSIONS)
def test_conditions_mean_what_pip_takes_them_for(version: str) -> None:
    """Of the real files, the same lines are selected as by the library that pip uses."""
    text = ''.join(path.read_text() for path in commands.MIRRORED)
    lines = [line for line in text.splitlines() if line and not line.startswith('#')]
    chosen = [
        line.partition(' ;')[0]
        for line in lines
        if (marker := Requirement(line).marker) is None
        or marker.evaluate({'python_full_version': f'{version}.4', 'python_version': version})
    ]
    assert len(chosen) > 200
    assert mirror.pins_for(text, version) == list(dict.fromkeys(chosen))


def test_unknown_condition() -> None:
    """A line of another form is not taken for one that always holds."""
    with pytest.raises(SetupError, match="not understood: x==1 ; sys_platform == 'linux'"):
        mirror.pins_for("x==1 ; sys_platform == 'linux'", '3.12')


def test_versions() -> None:
    """All by default; one without wheels is refused."""
    assert mirror.versions_of('') == list(mirror.VERSIONS)
    assert mirror.versions_of('3.12, 3.13') == ['3.12', '3.13']
    with pytest.raises(SetupError, match="no wheels for Python '3.9': choose among 3.10"):
        mirror.versions_of('3.9')


def test_download(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """pip is asked for the wheels of each version, and makes wheels of what is source only."""
    asked: list[list[str]] = []

    def run(command: list[Any], **_: Any) -> int:
        words = [str(each) for each in command]
        asked.append(words)
        if 'download' in words:
            pins = Path(words[words.index('--requirement') + 1]).read_text().split()
            asked[-1] = [words[words.index('--python-version') + 1], *pins]
            (folder / 'empy-3.tar.gz').touch()
        return 0

    folder = tmp_path / 'my wheels'
    pinned = tmp_path / 'requirements.txt'
    pinned.write_text(REQUIREMENTS)
    monkeypatch.setattr(mirror, 'run_logged', run)
    monkeypatch.setattr(mirror.wheels, 'has_pip', lambda _: True)
    place: Any = SimpleNamespace(environment=tmp_path, python='python3', root=tmp_path)
    mirror.make_mirror(place, folder, [pinned], ['3.10', '3.12'])
    assert asked[0] == ['3.10', 'numpy==2.2.6', 'wheel==1.0']
    assert asked[1] == ['3.12', 'numpy==2.5.5', 'wheel==1.0']
    assert asked[2][-1] == str(folder / 'empy-3.tar.gz') and 'wheel' in asked[2]
    assert sorted(path.name for path in folder.iterdir()) == ['COLCON_IGNORE']
    (folder / 'wheel-1.0-py3-none-any.whl').touch()
    mirror.make_mirror(place, folder, [pinned], ['3.12'])
    assert asked[3] == ['3.12', 'numpy==2.5.5'], 'a wheel that is there is asked for again'


def test_no_environment(tmp_path: Path) -> None:
    """Without an environment there is no pip, and the message says what to do."""
    place: Any = SimpleNamespace(environment=tmp_path, python=tmp_path / 'python3', root=tmp_path)
    with pytest.raises(SetupError, match='run `make setup` first'):
        mirror.make_mirror(place, tmp_path / 'wheels', [], ['3.12'])


def test_wheels_are_taken_from_the_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """pip gets its own variables, in which a path with a space is an address."""
    monkeypatch.setenv('PIP_NO_INDEX', '')
    monkeypatch.setenv('PIP_FIND_LINKS', '')
    folder = tmp_path / 'my wheels'
    folder.mkdir()
    (folder / 'x-1-py3-none-any.whl').touch()
    mirror.use_mirror(str(folder))
    from os import environ

    assert environ['PIP_NO_INDEX'] == '1'
    assert environ['PIP_FIND_LINKS'] == f'file://{tmp_path}/my%20wheels'


def test_empty_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A folder without wheels ends the set-up with a sentence, before anything is done."""
    assert commands.main(['setup', '--wheels', str(tmp_path)]) == 1
    assert f'There are no wheels in {tmp_path}: make them' in capsys.readouterr().err
