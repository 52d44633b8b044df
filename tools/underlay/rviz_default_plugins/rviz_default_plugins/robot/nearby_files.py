# SPDX-License-Identifier: Apache-2.0
"""The files that a mesh file refers to: materials and textures."""

from __future__ import annotations

import os
from pathlib import Path

from trimesh.resolvers import FilePathResolver

__all__ = ['NearbyFiles']


class NearbyFiles(FilePathResolver):
    """
    Resolver of file paths relative to a mesh, restricted to a folder.

    Only the paths are checked: the files themselves may be symbolic links out of the folder, as
    colcon installs them with --symlink-install.

    Parameters
    ----------
    mesh
        The file of the mesh.
    folder
        The folder, which contains it.

    """

    def __init__(self, mesh: Path, folder: Path) -> None:
        super().__init__(str(mesh))
        self._folder = folder

    def absolute(self, name: str) -> Path:
        """
        Resolve the path of a file.

        Parameters
        ----------
        name
            Its path relative to the folder of the mesh.

        Raises
        ------
        ValueError
            The path leads out of the folder.

        """
        path = Path(os.path.normpath(os.path.join(self.parent, name.strip())))
        if not path.is_relative_to(self._folder):
            raise ValueError(f"'{name}' is outside of {self._folder}.")
        return path
