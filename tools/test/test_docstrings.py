# SPDX-License-Identifier: Apache-2.0
"""Check that the docstrings of `src` explain the arguments of what they describe."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

SRC = Path(__file__).parents[2] / 'src'
PACKAGES = sorted(each.parent.name for each in SRC.glob('*/package.xml'))
HEADING = 'Parameters\n----------\n'
Function = ast.FunctionDef | ast.AsyncFunctionDef


def modules(package: str) -> Iterator[Path]:
    """Yield the modules of a package, without its tests."""
    for path in sorted((SRC / package).rglob('*.py')):
        if 'test' not in path.relative_to(SRC / package).parts:
            yield path


def public_functions(node: ast.AST) -> Iterator[Function]:
    """Yield the public functions of a module or class, and of its public classes."""
    for each in ast.iter_child_nodes(node):
        if isinstance(each, Function) and not each.name.startswith('_'):
            yield each
        elif isinstance(each, ast.ClassDef) and not each.name.startswith('_'):
            yield from public_functions(each)


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


@pytest.mark.parametrize('package', PACKAGES)
def test_arguments_are_explained(package: str) -> None:
    """Each by its name, in the section for that, and none that is not there."""
    wrong = []
    for path in modules(package):
        for function in public_functions(ast.parse(path.read_text())):
            wanted = arguments(function)
            found = explained(ast.get_docstring(function) or '')
            if wanted != found:
                where = f'{path.relative_to(SRC)}:{function.lineno} {function.name}'
                wrong.append(f'{where}: {sorted(wanted ^ found)}')
    assert not wrong, '\n'.join(wrong)
