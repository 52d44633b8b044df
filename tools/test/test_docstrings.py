# SPDX-License-Identifier: Apache-2.0
"""Check that docstrings explain the arguments of what they describe."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
FOLDERS = sorted(
    str(each.relative_to(ROOT))
    for each in (
        *(
            package.parent
            for place in ('src', 'tools/underlay')
            for package in (ROOT / place).glob('*/package.xml')
        ),
        *(
            ROOT / 'tools' / name
            for name in ('benchmarks', 'pictures', 'reference', 'setup', 'site', 'training')
        ),
    )
)
HEADING = 'Parameters\n----------\n'
Function = ast.FunctionDef | ast.AsyncFunctionDef


def modules(folder: Path) -> Iterator[Path]:
    """Yield the modules of a folder, without its tests."""
    for path in sorted(folder.rglob('*.py')):
        if 'test' not in path.relative_to(folder).parts:
            yield path


def explaining(node: ast.AST) -> Iterator[tuple[Function, str]]:
    """Yield public functions, also those of classes, and the docstrings that explain them."""
    for each in ast.iter_child_nodes(node):
        if isinstance(each, Function) and each.name == '__init__' and not is_error(node):
            yield each, ast.get_docstring(node) or ''
        elif isinstance(each, Function) and not each.name.startswith('_'):
            yield each, ast.get_docstring(each) or ''
        elif isinstance(each, ast.ClassDef) and not each.name.startswith('_'):
            yield from explaining(each)


def is_error(node: ast.AST) -> bool:
    """Return whether a class is one of exceptions, which are made where they are raised."""
    return any(ast.unparse(each).endswith(('Error', 'Exception')) for each in node.bases)


def arguments(function: Function) -> set[str]:
    """Return the names of what a function takes."""
    told = function.args
    every = [*told.posonlyargs, *told.args, *told.kwonlyargs, told.vararg, told.kwarg]
    return {each.arg for each in every if each is not None} - {'self', 'cls'}


def explained(docstring: str) -> set[str]:
    """Return the names of the arguments that a docstring explains."""
    _, _, section = docstring.partition(HEADING)
    names: set[str] = set()
    for line, below in zip(section.split('\n'), [*section.split('\n')[1:], '']):
        if below.startswith('---'):
            break
        if line and not line.startswith(' '):
            names.update(each.strip(' *') for each in line.partition(' : ')[0].split(','))
    return names


@pytest.mark.parametrize('folder', FOLDERS)
def test_arguments_are_explained(folder: str) -> None:
    """Each by its name, in the section for that, and none that is not there."""
    wrong = []
    for path in modules(ROOT / folder):
        for function, docstring in explaining(ast.parse(path.read_text())):
            wanted, found = arguments(function), explained(docstring)
            if wanted != found:
                where = f'{path.relative_to(ROOT)}:{function.lineno} {function.name}'
                wrong.append(f'{where}: {sorted(wanted ^ found)}')
    assert not wrong, '\n'.join(wrong)
