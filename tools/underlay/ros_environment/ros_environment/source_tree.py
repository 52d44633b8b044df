# SPDX-License-Identifier: Apache-2.0
"""The source tree of a colcon workspace: packages, what each installs, and what is newer."""

from __future__ import annotations

import ast
from collections.abc import Iterator
import filecmp
from fnmatch import fnmatch
import os
from pathlib import Path
from typing import NamedTuple

IGNORE_MARKERS = ('COLCON_IGNORE', 'AMENT_IGNORE', 'CATKIN_IGNORE')
SKIPPED_FOLDERS = ('build', 'install', 'log', 'node_modules', '__pycache__')
MAX_DEPTH = 6
MAX_FOLDERS = 4000

_SHARE = '/share/'


class SourcePackage(NamedTuple):
    """A package of the source tree."""

    name: str
    folder: Path


def find_workspace(start: Path) -> Path | None:
    """
    Find the nearest folder whose `src` folder contains packages.

    Parameters
    ----------
    start
        The first folder to search; its parents follow.

    Returns
    -------
    Path or None
        None if there is no such folder.

    """
    for folder in (start, *start.parents):
        if (folder / 'src').is_dir() and next(_package_folders(folder / 'src'), None):
            return folder
    return None


def source_packages(workspace: Path) -> dict[str, SourcePackage]:
    """
    Find the packages below the `src` folder of a workspace.

    Parameters
    ----------
    workspace
        The folder of the workspace.

    Returns
    -------
    dict[str, SourcePackage]
        The packages by name; of several with the same name, the first one.

    """
    found: dict[str, SourcePackage] = {}
    for folder in _package_folders(workspace / 'src'):
        name = _package_name(folder / 'package.xml')
        if name:
            found.setdefault(name, SourcePackage(name, folder))
    return found


def _package_folders(top: Path) -> Iterator[Path]:
    """Yield each folder with a package.xml, as colcon would find it; none inside a package."""
    depth_of_top = len(top.parts)
    walk = os.walk(top, followlinks=True)
    for count, (root, folders, files) in enumerate(walk):
        ignored = any(marker in files for marker in IGNORE_MARKERS)
        if 'package.xml' in files and not ignored:
            yield Path(root)
        too_deep = len(Path(root).parts) - depth_of_top >= MAX_DEPTH
        if ignored or too_deep or 'package.xml' in files:
            folders.clear()
        folders[:] = sorted(name for name in folders if not _is_skipped(name))
        if count >= MAX_FOLDERS:
            return


def _is_skipped(folder_name: str) -> bool:
    return folder_name.startswith('.') or folder_name in SKIPPED_FOLDERS


def _package_name(manifest: Path) -> str:
    from xml.etree import ElementTree

    try:
        return (ElementTree.parse(manifest).getroot().findtext('name') or '').strip()
    except (ElementTree.ParseError, OSError):
        return ''


class StaleFiles:
    """Compares installed files with their sources; a package is searched once."""

    def __init__(self) -> None:
        """Start without cached packages."""
        self._folders: dict[tuple[Path, str], Path | None] = {}

    def newer_source(self, path: str) -> str:
        """
        Find the source of an installed file if it has been changed since.

        Parameters
        ----------
        path
            The installed file, below `share/PACKAGE` of a prefix.

        Returns
        -------
        str
            The newer source file; '' if the installed one is up to date, or a link to its source.

        """
        prefix, share, rest = path.rpartition(_SHARE)
        package, _, relative = rest.partition('/')
        if not (share and relative) or not _is_copy(path, prefix):
            return ''
        folder = self._source_folder(_workspace(Path(prefix), package), package)
        source = '' if folder is None else os.path.join(folder, relative)
        return source if source and _is_newer(source, path) else ''

    def _source_folder(self, workspace: Path, package: str) -> Path | None:
        key = (workspace, package)
        if key not in self._folders:
            self._folders[key] = _find_source_folder(workspace, package)
        return self._folders[key]


def _workspace(prefix: Path, package: str) -> Path:
    """Return the workspace of an install folder, in which each package may have its own."""
    return prefix.parent.parent if prefix.name == package else prefix.parent


def _find_source_folder(workspace: Path, package: str) -> Path | None:
    """Return the folder of a package; the usual places are searched first."""
    if not (workspace / 'src').is_dir():
        return None
    for folder in (workspace / 'src' / package, *(workspace / 'src').glob(f'*/{package}')):
        if (folder / 'package.xml').is_file():
            return folder
    found = source_packages(workspace).get(package)
    return None if found is None else found.folder


def _is_copy(path: str, prefix: str) -> bool:
    """Whether an installed file is a copy below the prefix, not a link to its source."""
    return os.path.realpath(path).startswith(os.path.realpath(prefix) + os.sep)


def _is_newer(source: str, installed: str) -> bool:
    try:
        if os.stat(source).st_mtime_ns <= os.stat(installed).st_mtime_ns:
            return False
        return not filecmp.cmp(source, installed, shallow=False)
    except OSError:
        return False


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
        None if the file cannot be read or is not valid Python.

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
    """Return the console scripts by name; None if the script declares no such list."""
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
    """Whether data_files contains anything but literals, `glob` and joined paths."""
    calls = [node for node in ast.walk(data_files) if isinstance(node, ast.Call)]
    known = all(_called_name(call) in ('glob', 'join') for call in calls)
    return not known or not isinstance(data_files, (ast.List, ast.Tuple))
