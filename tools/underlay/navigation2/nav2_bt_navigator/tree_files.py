# SPDX-License-Identifier: Apache-2.0
"""Find and read the files of trees; a file that has not changed is read once."""

from __future__ import annotations

import os

from ament_index_python.packages import get_package_share_directory
from nav2_behavior_tree import Document, read_tree_file

__all__ = ['TREE_FOLDER', 'TreeFiles', 'find_tree_file']


def _tree_folder() -> str:
    """Return where the trees are: beside this file in the source, in the share folder else."""
    beside = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'behavior_trees')
    if os.path.isdir(beside):
        return beside
    return os.path.join(get_package_share_directory('nav2_bt_navigator'), 'behavior_trees')


TREE_FOLDER = _tree_folder()
"""Where the trees of this package are."""
_OFFICIAL_FOLDER = os.path.join('nav2_bt_navigator', 'behavior_trees')


def find_tree_file(path: str) -> str:
    """
    Return the file that is meant by a path.

    Parameters
    ----------
    path
        A path, or the name of a tree of this package. Where a path leads to the trees of an
        installation of Nav2 that is not there, the tree of the same name of this package is meant.

    """
    folder, name = os.path.split(path)
    own = os.path.join(TREE_FOLDER, name)
    is_ours = not folder or os.path.normpath(folder).endswith(_OFFICIAL_FOLDER)
    return own if is_ours and not os.path.isfile(path) and os.path.isfile(own) else path


class TreeFiles:
    """The files that were read."""

    def __init__(self) -> None:
        self._known: dict[str, tuple[float, Document]] = {}

    def read(self, path: str) -> Document:
        """
        Read a file of trees, or return what was read of it before if it has not changed.

        Parameters
        ----------
        path
            The XML file; one that includes others is always read.

        Raises
        ------
        TreeError
            It cannot be read, or is not right.

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
