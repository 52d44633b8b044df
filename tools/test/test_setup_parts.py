# SPDX-License-Identifier: Apache-2.0
"""Wheels of parts of the robot wait until a command names the part."""

from __future__ import annotations

from pathlib import Path
import subprocess
import sys

from console import Steps
from locations import Locations
from parts import Parts, read_parts
import pytest
import wheels

REQUIREMENTS = """\
# Made by a program.

# [voice] words: voice speech; modules: ear
ear-of-robots==1.0
sound==2.0 ; python_full_version < '3.11'

# [eyes] words: eyes full; modules: eye lens
eye==3.0
"""


@pytest.fixture
def locations(tmp_path: Path) -> Locations:
    """Return a workspace with an empty environment."""
    environment = tmp_path / '.venv'
    (environment / 'lib' / 'python3.11' / 'site-packages').mkdir(parents=True)
    (tmp_path / 'requirements-parts.txt').write_text(REQUIREMENTS)
    return Locations(tmp_path, environment, environment)


@pytest.fixture
def installed(locations: Locations, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Let pip only note what it is given, and put packages where wheels would."""
    runs: list[str] = []

    def install(there: Locations, steps: Steps, include: str, requirements: Path) -> None:
        runs.append(requirements.read_text())
        names = [line.partition('==')[0] for line in requirements.read_text().splitlines()]
        for name in names:
            package = wheels.site_packages(there) / name.partition('-')[0]
            package.mkdir(exist_ok=True)
            (package / '__init__.py').touch()

    monkeypatch.setattr(wheels, 'install_wheels', install)
    return runs


def names(locations: Locations, asked_for: str = '', *, everything: bool = False) -> list[str]:
    """Install what a command wants, as the set-up does, and return the names of the parts."""
    parts = Parts(locations, locations.root / 'requirements-parts.txt', asked_for)
    missing = parts.to_install(everything=everything)
    parts.install(missing, Steps(1))
    parts.describe_others()
    return [part.name for part in missing]


def test_a_part_is_installed_when_it_is_named(locations: Locations, installed: list[str]) -> None:
    """Once, by a word in the arguments; afterwards it is kept as pinned, whatever is asked for."""
    assert names(locations) == []
    assert names(locations, 'scene:=room voice:=false') == []
    assert names(locations, 'voice:=true') == ['voice']
    assert names(locations, 'speech_backend:=whisper') == []
    assert installed == ["ear-of-robots==1.0\nsound==2.0 ; python_full_version < '3.11'\n"]
    changed = REQUIREMENTS.replace('robots==1.0', 'robots==1.1').replace('eye==3.0', 'eye==3.1')
    (locations.root / 'requirements-parts.txt').write_text(changed)
    assert names(locations) == ['voice']
    assert names(locations, everything=True) == ['eyes']


def test_who_imports_what_is_missing_is_told(locations: Locations, installed: list[str]) -> None:
    """The sentence names the part and the command; once it is there, it is imported."""
    names(locations, 'voice:=true')
    packages = wheels.site_packages(locations)

    def imported(module: str) -> str:
        command = [sys.executable, '-c', f'import {module}']
        done = subprocess.run(
            command, env={'PYTHONPATH': str(packages)}, capture_output=True, text=True
        )
        return done.stderr

    assert (
        'eye is not installed yet, because only eyes needs it: run `make setup` in '
        f'{locations.root}'
    ) in imported('eye')
    assert 'ModuleNotFoundError' not in imported('lens')
    assert imported('ear') == ''
    names(locations, everything=True)
    assert imported('eye') == ''


def test_the_parts_of_this_workspace(root: Path) -> None:
    """Each is pinned, and not in requirements.txt; the full system takes all that robots need."""
    parts = read_parts((root / 'requirements-parts.txt').read_text())
    listed = [part.name for part in parts]
    assert listed == ['navigation', 'vision', 'planner', 'sweep', 'gym', 'policy', 'voice']
    base = (root / 'requirements.txt').read_text().splitlines()
    for part in parts:
        assert part.is_asked_for('full_system') == (part.name not in ('sweep', 'gym', 'policy'))
        assert not part.is_asked_for('scene:=apartment gui:=false')
        assert part.pins and all('==' in pin for pin in part.pins)
        assert not set(part.pins) & set(base)


def test_parts_of_another_file_and_command(locations: Locations, installed: list[str]) -> None:
    """Pins may have digests; the sentence names the command that installs them."""
    pins = 'ear==1.0 \\\n    --hash=sha256:12\n'
    path = locations.root / 'requirements-cluster.txt'
    path.write_text(f'# [cluster] words: ; modules: ear\n{pins}')
    parts = Parts(locations, path, command='make cluster')
    parts.describe_others()
    stub = wheels.site_packages(locations) / 'ear.py'
    assert f'run `make cluster` in {locations.root}' in stub.read_text()
    assert parts.to_install(everything=False) == []
    parts.install(parts.to_install(everything=True), Steps(1))
    assert installed == [pins] and not stub.exists()
    assert parts.to_install(everything=True) == []


def test_what_clusters_need(root: Path) -> None:
    """Every pin has digests; no command asks for it; versions are those of the others."""
    text = (root / 'requirements-cluster.txt').read_text()
    (part,) = read_parts(text)
    assert part.modules == ('ray',) and not part.is_asked_for('cluster ray sweep full_system')
    pins = [each.split()[0] for each in part.pins if '==' in each]
    assert len(pins) == len(wheels.pinned_names(text)) and 'ray' in wheels.pinned_names(text)
    assert all(line.endswith('\\') for line in part.pins if '==' in line)
    assert all('--hash=sha256:' in line for line in part.pins if '==' not in line)
    others = ''.join(
        (root / f'requirements{each}.txt').read_text() for each in ('', '-parts', '-test')
    )
    shared = {*wheels.pinned_names(text)} & {*wheels.pinned_names(others)}
    assert {pin for pin in pins if pin.partition('==')[0] in shared} <= {*others.split()}
