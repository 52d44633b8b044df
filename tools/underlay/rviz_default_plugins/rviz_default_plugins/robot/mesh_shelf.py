# SPDX-License-Identifier: Apache-2.0
"""The mesh cache of a robot."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from rviz_default_plugins.robot.mesh import DrawnMesh
from rviz_default_plugins.robot.mesh_error import MeshError
from rviz_default_plugins.robot.mesh_file import find_mesh, folder_of
from rviz_default_plugins.robot.mesh_loading import load_mesh

__all__ = ['MeshShelf']


class MeshShelf:
    """
    Cache of the meshes of a robot by name, and of the reasons why some cannot be shown.

    Parameters
    ----------
    before
        Another cache, whose meshes are reused as long as their files are unchanged.

    Attributes
    ----------
    meshes
        The meshes that have been read, by the names in the URDF.
    complaints
        A message for each mesh that is missing, broken or simplified.

    """

    def __init__(self, before: MeshShelf | None = None) -> None:
        self._read: dict[Path, tuple[int, DrawnMesh]] = dict(before._read) if before else {}
        self.meshes: dict[str, DrawnMesh] = {}
        self.complaints: list[str] = []

    def read(self, names: Iterable[str]) -> None:
        """
        Read meshes that are not in the cache; this may take seconds.

        Parameters
        ----------
        names
            The names in the URDF, as for `find_file`.

        """
        for name in dict.fromkeys(names):
            try:
                mesh = self.meshes[name] = self._mesh(name)
            except MeshError as error:
                self.complaints.append(str(error))
            except OSError as error:
                self.complaints.append(f"'{name}' cannot be read: {error.strerror}.")
            else:
                if mesh.warning:
                    self.complaints.append(mesh.warning)

    def _mesh(self, name: str) -> DrawnMesh:
        path = find_mesh(name)
        changed_ns = path.stat().st_mtime_ns
        known = self._read.get(path)
        if known is None or known[0] != changed_ns:
            known = self._read[path] = changed_ns, load_mesh(path, name, folder_of(name))
        return known[1]
