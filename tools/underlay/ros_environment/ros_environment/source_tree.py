# SPDX-License-Identifier: Apache-2.0
"""The source tree of a colcon workspace: its packages, and what is newer than installed."""

from __future__ import annotations

from collections.abc import Iterator
import filecmp
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
        Where the search begins, which goes on in the folders above.

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
        The packages by name; the first one counts if there are several of a name.

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
        """Begin without any package."""
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
    """Return the folder of a package; the usual places are looked at first."""
    if not (workspace / 'src').is_dir():
        return None
    for folder in (workspace / 'src' / package, *(workspace / 'src').glob(f'*/{package}')):
        if (folder / 'package.xml').is_file():
            return folder
    found = source_packages(workspace).get(package)
    return None if found is None else found.folder


def _is_copy(path: str, prefix: str) -> bool:
    """Return whether a file really lies below a prefix, and is not a link to its source."""
    return os.path.realpath(path).startswith(os.path.realpath(prefix) + os.sep)


def _is_newer(source: str, installed: str) -> bool:
    try:
        if os.stat(source).st_mtime_ns <= os.stat(installed).st_mtime_ns:
            return False
        return not filecmp.cmp(source, installed, shallow=False)
    except OSError:
        return False
