# SPDX-License-Identifier: Apache-2.0
"""Tests that the generated reference is that of the code."""

from __future__ import annotations

from importlib import import_module
import importlib.util
from pathlib import Path
import re
from types import ModuleType

import pytest


@pytest.fixture
def generate(root: Path) -> ModuleType:
    """Return the generator."""
    path = root / 'tools' / 'reference' / 'generate.py'
    spec = importlib.util.spec_from_file_location('generate', path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_launch_files_are_described_as_they_are(root: Path, generate: ModuleType) -> None:
    """An argument that was added is in the reference: otherwise `make docs` was forgotten."""
    written = (root / 'docs' / 'reference' / 'launch_files.md').read_text()
    assert written == generate.launch_page()


def test_packages_of_others_are_not_described(
    generate: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A package that somebody makes in src/ has another maintainer, and is no part of it."""
    folder = tmp_path / 'src' / 'arm'
    (folder / 'launch').mkdir(parents=True)
    (folder / 'launch' / 'arm.launch.py').touch()
    manifest = '<package><maintainer email="me@example.com">Me</maintainer></package>'
    (folder / 'package.xml').write_text(manifest)
    monkeypatch.setattr(generate, 'ROOT', tmp_path)
    assert '## ros2 launch' not in generate.launch_page()


def test_the_names_of_launch_files_are_described(root: Path, generate: ModuleType) -> None:
    """Each class, its arguments and its tags are in the reference."""
    written = (root / 'docs' / 'reference' / 'launch_names.md').read_text()
    assert written == generate.names_page()
    assert '| `Node` | `node` | `executable`, `package=`,' in written


def test_the_displays_are_described(root: Path, generate: ModuleType) -> None:
    """Each display, panel, tool and view and its properties are in the reference."""
    written = (root / 'docs' / 'reference' / 'displays.md').read_text()
    assert written == generate.displays_page()
    assert '| `Plane` | `XY`, `XZ`, `YZ` | `XY` |' in written


def test_the_parameters_are_described(root: Path, generate: ModuleType) -> None:
    """Each parameter of each node is in the reference, with its limits and its meaning."""
    written = (root / 'docs' / 'reference' / 'parameters.md').read_text()
    assert written == generate.parameters_page()
    assert '| `physics_rate_hz` | a number, from 100 to 5000 | 500.0 |' in written


def test_each_node_with_parameters_is_described(root: Path) -> None:
    """The reference knows every class of parameters that a node of this project declares."""
    import node_parameters  # tools/reference is on the path here
    from own_packages import is_own_package

    described = {path.rpartition('.')[2] for path in node_parameters.NODES.values()}
    declared = {
        name
        for manifest in (root / 'src').glob('*/package.xml')
        if is_own_package(manifest.parent)
        for path in (manifest.parent / manifest.parent.name).rglob('*.py')
        for name in re.findall(r'NodeParameters\(self, (\w+)', path.read_text())
    }
    assert 'HostParameters' in declared
    assert declared - described == set()


def test_the_skills_are_described(root: Path, generate: ModuleType) -> None:
    """Each skill of the file is in the reference, with its arguments and limits."""
    written = (root / 'docs' / 'reference' / 'skills.md').read_text()
    assert written == generate.skills_page()
    assert '| `angle` | a number of degrees, from 1 to 360 | 90 |' in written


def test_the_sentences_of_the_reference_are_understood(root: Path) -> None:
    """Each phrase of each skill has an example; what it asks for may not be possible alone."""
    import skills  # tools/reference is on the path here

    planner = import_module('llm_planner.rules').RulePlanner(skills.load(root))
    world_of = import_module('llm_planner.world').World
    places = {'desk': 'study', 'kitchen_table': 'kitchen'}
    world = world_of(places, ('kitchen', 'hall', 'study'))
    dialogue_of = import_module('llm_planner.dialogue').Dialogue
    said = skills.all_sentences(root)
    assert len(said) > 40
    for text in said:
        outcome = planner.plan(text, world, dialogue_of())
        assert 'not understand' not in getattr(outcome, 'text', ''), text


def test_every_verb_is_described(root: Path, generate: ModuleType) -> None:
    """Each command and verb has its section; how options are laid out depends on the Python."""
    written = (root / 'docs' / 'reference' / 'commands.md').read_text()
    headings = [line for line in written.splitlines() if line.startswith('##')]
    present = generate.commands_page().splitlines()
    assert headings == [line for line in present if line.startswith('##')]
    assert len(headings) > 10
