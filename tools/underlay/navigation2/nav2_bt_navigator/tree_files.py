# SPDX-License-Identifier: Apache-2.0
"""Find and read behavior tree files; unchanged files are cached."""

from __future__ import annotations

import os

from ament_index_python.packages import get_package_share_directory
from nav2_behavior_tree.tree_xml import Document, read_tree_file

__all__ = ['TREE_FOLDER', 'TreeFiles', 'find_tree_file']


def _tree_folder() -> str:
    """Find the tree folder: next to this file in the source, else in the share folder."""
    beside = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'behavior_trees')
    if os.path.isdir(beside):
        return beside
    return os.path.join(get_package_share_directory('nav2_bt_navigator'), 'behavior_trees')


TREE_FOLDER = _tree_folder()
"""The folder with the trees of this package."""
_OFFICIAL_FOLDER = os.path.join('nav2_bt_navigator', 'behavior_trees')


def find_tree_file(path: str) -> str:
    """
    Resolve the path of a behavior tree file.

    Parameters
    ----------
    path
        A path, or the name of a tree of this package. A path into an installation of Nav2 that
        does not exist is replaced by the tree of this package with the same name.

    """
    folder, name = os.path.split(path)
    own = os.path.join(TREE_FOLDER, name)
    is_ours = not folder or os.path.normpath(folder).endswith(_OFFICIAL_FOLDER)
    return own if is_ours and not os.path.isfile(path) and os.path.isfile(own) else path


class TreeFiles:
    """Cache of tree files."""

    def __init__(self) -> None:
        self._known: dict[str, tuple[float, Document]] = {}

    def read(self, path: str) -> Document:
        """
        Read a file of trees, from the cache if it has not changed.

        Parameters
        ----------
        path
            The XML file; one with includes is always read again.

        Raises
        ------
        TreeError
            It cannot be read, or is invalid.

        """
        try:
            changed = os.stat(path).st_mtime
        except OSError:
            changed = 0.0
        known = self._known.get(path)
        if known is None or known[0] != changed or not changed or _has_includes(known[1]):
            known = self._known[path] = changed, read_tree_file(path)
        return known[1]


def _has_includes(document: Document) -> bool:
    return any(tree.file != document.file for tree in document.trees.values())
