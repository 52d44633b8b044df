# SPDX-License-Identifier: Apache-2.0
"""Find out from its source what a Python script imports, without running any of it."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from importlib.metadata import distribution, PackageNotFoundError
from importlib.util import find_spec
import os
import re
import sys
from typing import Optional

# As setuptools writes it into the scripts that it installs.
_ENTRY_POINT = re.compile(
    r"""['"]([^'"=]+)(?:==[^'"]*)?['"], *['"]console_scripts['"], *['"]([^'"]+)"""
)
_MOST_MODULES = 300

Import = tuple[str, tuple[str, ...]]
"""A module, and the names that are imported from it."""


def imports_of(scripts: Sequence[str]) -> Iterator[Import]:
    """
    Yield what Python scripts import from outside the workspace, without running them.

    Modules that are not installed with this Python are followed into their sources, up to a fixed
    number. Scripts that setuptools has installed are followed to the module of their entry point.

    Parameters
    ----------
    scripts
        Paths of Python files; one that cannot be read or parsed has no imports.

    Yields
    ------
    Import
        A module that is not followed, and the names imported from it.

    """
    waiting = [item for script in scripts for item in _imports_of_script(script)]
    seen: set[Import] = set()
    while waiting and len(seen) < _MOST_MODULES:
        item = waiting.pop()
        if item in seen:
            continue
        seen.add(item)
        path = _workspace_file(item[0])
        if path is None:
            yield item
        else:
            waiting += _imports_in(path)
            waiting += [(f'{item[0]}.{name}', ()) for name in item[1]]


def _imports_of_script(script: str) -> Iterator[Import]:
    yield from _imports_in(script)
    for project, name in _ENTRY_POINT.findall(_text(script)):
        try:
            points = distribution(project).entry_points
        except PackageNotFoundError:
            continue
        for point in points:
            if point.group == 'console_scripts' and point.name == name:
                yield point.value.partition(':')[0].strip(), ()


def _imports_in(path: str) -> Iterator[Import]:
    """Yield what the top level of a file imports."""
    try:
        tree = ast.parse(_text(path))
    except (SyntaxError, ValueError):
        return
    for statement in tree.body:
        if isinstance(statement, ast.Import):
            yield from ((alias.name, ()) for alias in statement.names)
        elif isinstance(statement, ast.ImportFrom) and statement.module and not statement.level:
            yield statement.module, tuple(alias.name for alias in statement.names)


def _text(path: str) -> str:
    try:
        with open(path, encoding='utf-8') as file:
            return file.read()
    except (OSError, ValueError):
        return ''


def _workspace_file(module: str) -> Optional[str]:
    """Return the file of a module that is not installed with this Python, None for others."""
    top, *rest = module.split('.')
    if top in sys.stdlib_module_names:
        return None
    spec = find_spec(top)
    if spec is None or spec.origin is None or _belongs_to_python(spec.origin):
        return None
    base = spec.origin
    if rest:
        folder = os.path.dirname(base)
        base = os.path.join(folder, *rest)
        base = os.path.join(base, '__init__.py') if os.path.isdir(base) else f'{base}.py'
    return base if os.path.isfile(base) else None


def _belongs_to_python(path: str) -> bool:
    return path.startswith((f'{sys.prefix}{os.sep}', f'{sys.base_prefix}{os.sep}'))
