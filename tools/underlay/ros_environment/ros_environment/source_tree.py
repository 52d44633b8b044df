# SPDX-License-Identifier: Apache-2.0
"""The packages in the source tree of a colcon workspace."""

from __future__ import annotations

from collections.abc import Iterator
import os
from pathlib import Path
from typing import NamedTuple

IGNORE_MARKERS = ('COLCON_IGNORE', 'AMENT_IGNORE', 'CATKIN_IGNORE')
SKIPPED_FOLDERS = ('build', 'install', 'log', 'node_modules', '__pycache__')
MAX_DEPTH = 6
MAX_FOLDERS = 4000


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
