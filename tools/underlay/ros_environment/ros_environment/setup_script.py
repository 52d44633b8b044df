# SPDX-License-Identifier: Apache-2.0
"""What a package's setup.py installs, read from its text; the file is never executed."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from fnmatch import fnmatch
from pathlib import Path
from typing import NamedTuple


class SetupScript(NamedTuple):
    """The parts of a setup.py that decide which executables and data files are installed."""

    scripts: dict[str, str]
    has_console_scripts: bool
    data_patterns: tuple[str, ...]
    data_is_computed: bool
    has_package_name: bool

    def installs(self, relative_path: str) -> bool:
        """
        Check whether `data_files` names a file, or has a pattern that matches it.

        Parameters
        ----------
        relative_path
            The path in the folder of the package, with slashes.

        """
        return any(_matches(relative_path, pattern) for pattern in self.data_patterns)


def read_setup_script(path: Path) -> SetupScript | None:
    """
    Parse what a setup.py installs, without running it.

    Parameters
    ----------
    path
        The file.

    Returns
    -------
    SetupScript or None
        None if the file cannot be read or is no valid Python.

    """
    try:
        tree = ast.parse(path.read_text(encoding='utf-8'))
    except (OSError, SyntaxError, ValueError):
        return None
    keywords = _setup_keywords(tree)
    scripts = _console_scripts(keywords.get('entry_points'))
    data = keywords.get('data_files')
    names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    return SetupScript(
        scripts or {},
        scripts is not None,
        tuple(_texts(data)) if data else (),
        data is not None and _is_computed(data),
        'package_name' in names,
    )


def defines_main(module: Path) -> bool:
    """
    Check whether a module defines or imports a function `main` at its top level.

    Parameters
    ----------
    module
        The file of the module.

    """
    try:
        tree = ast.parse(module.read_text(encoding='utf-8'))
    except (OSError, SyntaxError, ValueError):
        return False
    return any(
        (isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)) and node.name == 'main')
        or (isinstance(node, ast.ImportFrom) and 'main' in [item.name for item in node.names])
        for node in tree.body
    )


def _setup_keywords(tree: ast.Module) -> dict[str, ast.expr]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and _called_name(node) == 'setup':
            return {word.arg: word.value for word in node.keywords if word.arg}
    return {}


def _called_name(call: ast.Call) -> str:
    function = call.func
    if isinstance(function, ast.Attribute):
        return function.attr
    return function.id if isinstance(function, ast.Name) else ''


def _console_scripts(entry_points: ast.expr | None) -> dict[str, str] | None:
    """Return the console scripts by name, or None if the script does not declare any list."""
    if not isinstance(entry_points, ast.Dict):
        return None
    for key, value in zip(entry_points.keys, entry_points.values):
        if isinstance(key, ast.Constant) and key.value == 'console_scripts':
            pairs = (text.partition('=') for text in _texts(value) if '=' in text)
            return {name.strip(): target.strip() for name, _, target in pairs}
    return None


def _texts(node: ast.AST) -> Iterator[str]:
    """Yield all literal texts in an expression; joined paths come out as one text."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.value
    elif isinstance(node, ast.Call) and _called_name(node) == 'join':
        yield '/'.join(text for argument in node.args for text in _texts(argument))
    else:
        for child in ast.iter_child_nodes(node):
            yield from _texts(child)


def _matches(path: str, pattern: str) -> bool:
    """Match a path against a glob pattern, in which only `**` stands for several folders."""
    if '**' in pattern:
        return fnmatch(path, pattern.replace('**/', '*'))
    parts, patterns = path.split('/'), pattern.split('/')
    return len(parts) == len(patterns) and all(map(fnmatch, parts, patterns))


def _is_computed(data_files: ast.expr) -> bool:
    """Tell if data_files uses anything but literals, `glob` and joined paths."""
    calls = [node for node in ast.walk(data_files) if isinstance(node, ast.Call)]
    known = all(_called_name(call) in ('glob', 'join') for call in calls)
    return not known or not isinstance(data_files, (ast.List, ast.Tuple))
