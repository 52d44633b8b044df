# SPDX-License-Identifier: Apache-2.0
"""Nothing that decides what the robot does may know what only the simulator knows."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[2]
TRUTH = ('ground_truth', 'entity_state', 'get_entit', 'entities_states', 'get_named_poses')
WORLD = 'world'
JUDGES = {
    'humanoid_navigation/humanoid_navigation/testing.py',
    'humanoid_simulation/humanoid_simulation/examples/push_test.py',
    'humanoid_simulation/humanoid_simulation/examples/walk_square.py',
}
"""What drives a robot, and compares with the truth how far off that was."""


def deciding() -> Iterator[Path]:
    """Yield the modules of all packages, apart from tests and the simulator itself."""
    for path in sorted(SOURCES.rglob('*.py')):
        parts = path.relative_to(SOURCES).parts
        is_decided = parts[0] == 'humanoid_simulation' or {'test', 'build'} & set(parts)
        if not is_decided and '/'.join(parts) not in JUDGES:
            yield path


def texts(path: Path) -> Iterator[str]:
    """Yield the texts of a module that are not docstrings."""
    tree = ast.parse(path.read_text())
    docs = {
        id(node.body[0].value)
        for node in ast.walk(tree)
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef))
        and node.body
        and isinstance(node.body[0], ast.Expr)
    }
    for node in ast.walk(tree):
        is_text = isinstance(node, ast.Constant) and isinstance(node.value, str)
        if is_text and id(node) not in docs:
            yield node.value


def test_no_module_that_decides_names_what_is_true() -> None:
    """Neither the topics and services of the truth, nor the frame of the world."""
    found = [
        f'{path.relative_to(SOURCES)}: {text!r}'
        for path in deciding()
        for text in texts(path)
        if text == WORLD or any(name in text for name in TRUTH)
    ]
    assert found == []


def test_there_are_modules_that_decide() -> None:
    """The test looks at something."""
    assert len(list(deciding())) > 100


def test_the_robots_in_the_simulator_get_sensors_alone() -> None:
    """The control of a robot is given observations; the scene is not among its arguments."""
    control = SOURCES / 'humanoid_control' / 'humanoid_control'
    for path in control.rglob('*.py'):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.ImportFrom) and node.module:
                assert not node.module.startswith('humanoid_simulation'), path


def test_only_viewers_and_judges_subscribe_in_the_simulator_package() -> None:
    """Within the package, too, who reads the truth is known by name."""
    package = SOURCES / 'humanoid_simulation' / 'humanoid_simulation'
    for path in sorted(package.rglob('*.py')):
        name = str(path.relative_to(SOURCES))
        if name in JUDGES or 'testing' in path.parts:
            continue
        for node in ast.walk(ast.parse(path.read_text())):
            if (
                isinstance(node, ast.Call)
                and isinstance(node.func, ast.Attribute)
                and node.func.attr == 'create_subscription'
            ):
                assert 'ground_truth' not in ast.unparse(node), path
