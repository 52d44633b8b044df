# SPDX-License-Identifier: Apache-2.0
"""Find the imports of a Python script by parsing its source, without running it."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from importlib.metadata import distribution, PackageNotFoundError
from importlib.util import find_spec
import os
import re
import sys
from typing import Optional

# Entry point reference in the console scripts that setuptools installs.
_ENTRY_POINT = re.compile(
    r"""['"]([^'"=]+)(?:==[^'"]*)?['"], *['"]console_scripts['"], *['"]([^'"]+)"""
)
_MOST_MODULES = 300

Import = tuple[str, tuple[str, ...]]
"""A module and the names imported from it."""


def imports_of(scripts: Sequence[str]) -> Iterator[Import]:
    """
    Yield the imports of Python scripts from outside the workspace, without running them.

    The sources of modules that are not installed with this Python are searched in turn, up to a
    fixed number. Console scripts that setuptools installed are resolved to their entry points.

    Parameters
    ----------
    scripts
        Paths of Python files; files that cannot be read or parsed yield nothing.

    Yields
    ------
    Import
        A module outside the workspace and the names imported from it.

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
    """Yield the top-level imports of a file."""
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
    """Return the source file of a module outside this Python installation, or None."""
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
