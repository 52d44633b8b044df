# SPDX-License-Identifier: Apache-2.0
"""Where the meshes of a model are, and how far they extend."""

from __future__ import annotations

from pathlib import Path
from urllib.parse import unquote

from humanoid_common.naming import did_you_mean
from humanoid_description.errors import DescriptionError
from humanoid_description.geometry import outline
from humanoid_description.robot import Array, Shape
import numpy as np

_FACET = np.dtype([('normal', '<f4', 3), ('corners', '<f4', (3, 3)), ('attribute', '<u2')])
_HEADER_BYTES = 84
"""Of a binary STL: a comment of 80 bytes, and the number of facets."""


def is_remote(file: str) -> bool:
    """
    Check whether the URI of a mesh refers to another machine.

    Parameters
    ----------
    file
        The file name of a mesh, as in a URDF.

    """
    scheme, separator, _ = file.partition('://')
    return bool(separator) and scheme not in ('file', 'package')


def mesh_path(file: str, folder: Path) -> Path:
    """
    Resolve the path of a mesh, which need not exist.

    Parameters
    ----------
    file
        The file name of a mesh, as in a URDF, that is not remote.
    folder
        The folder that a name without a scheme is relative to.

    Raises
    ------
    DescriptionError
        There is no such package.

    """
    scheme, separator, rest = file.partition('://')
    if not separator:
        return folder / file
    if scheme == 'file':
        return Path(unquote(rest))
    package, _, inside = rest.partition('/')
    return _share(package) / inside


def _share(package: str) -> Path:
    """Return the share directory of a package; raise DescriptionError if it does not exist."""
    from ament_index_python.packages import (
        get_package_share_directory,
        get_packages_with_prefixes,
        PackageNotFoundError,
    )

    try:
        return Path(get_package_share_directory(package))
    except (PackageNotFoundError, ValueError) as error:
        hint = did_you_mean(package, get_packages_with_prefixes())
        raise DescriptionError(
            f"there is no package '{package}'. "
            + (hint or 'Install or build it, and source its setup file.')
        ) from error


def bounds(shape: Shape, pose: Array, folder: Path) -> Array | None:
    """
    Compute the bounding box of a shape.

    Parameters
    ----------
    shape
        A visual or collision shape.
    pose
        The pose (4, 4) of its link in any frame.
    folder
        The folder that the file name of a mesh is relative to if it has no scheme.

    Returns
    -------
    Array or None
        The lowest and the highest coordinates (2, 3) in m in that frame; None for a mesh whose
        vertices are not known: one that is remote, or not a binary STL.

    """
    if shape.kind != 'mesh':
        corners = outline([shape], pose)
    else:
        vertices = _vertices(shape.file, folder)
        if not len(vertices):
            return None
        at = pose @ shape.pose
        corners = vertices * shape.size_m @ at[:3, :3].T + at[:3, 3]
    return np.array([corners.min(axis=0), corners.max(axis=0)])


def _vertices(file: str, folder: Path) -> Array:
    """Read the vertices (n, 3) of a binary STL; none of any other file."""
    nothing: Array = np.zeros((0, 3))
    if is_remote(file):
        return nothing
    try:
        content = mesh_path(file, folder).read_bytes()
    except OSError:
        return nothing
    facets, rest = divmod(len(content) - _HEADER_BYTES, _FACET.itemsize)
    if rest or facets < 1 or int.from_bytes(content[80:84], 'little') != facets:
        return nothing
    corners = np.frombuffer(content, _FACET, offset=_HEADER_BYTES)['corners']
    return corners.reshape(-1, 3).astype(np.float64)
