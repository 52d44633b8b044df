# SPDX-License-Identifier: Apache-2.0
"""Find installed files that are older than the files of the workspace they come from."""

from __future__ import annotations

import filecmp
import os
from pathlib import Path

from ros_environment.source_tree import source_packages

_SHARE = '/share/'


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
