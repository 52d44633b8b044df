# SPDX-License-Identifier: Apache-2.0
"""How mesh files are read, simplified and cached."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from math import isqrt, radians
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rviz_default_plugins.robot.mesh_file import find_mesh, folder_of, MeshError
from urdf import Color

__all__ = ['DrawnMesh', 'MeshShelf', 'Surface', 'creased', 'load_mesh', 'thinned']

Vertices = NDArray[np.float32]
Faces = NDArray[np.uint32]

MAX_BYTES = 100_000_000
MAX_TRIANGLES = 200_000

STEP = 0.7

CREASE_RAD = radians(35.0)
"""Facets of an STL file that enclose a smaller angle are shaded as one smooth surface."""


@dataclass(frozen=True)
class Surface:
    """
    Triangles, with their colour if they have one; `glb` has all colours and textures.

    Nobody sees the inside of a closed surface; its triangles face outwards.
    """

    vertices: Vertices
    faces: Faces
    color: Color | None = None
    glb: bytes | None = None
    is_closed: bool = False


@dataclass(frozen=True)
class DrawnMesh:
    """The contents of a mesh file, in metres; `warning` reports if they are incomplete."""

    surfaces: tuple[Surface, ...]
    is_flat: bool = False
    warning: str = ''

    @property
    def triangle_count(self) -> int:
        """The number of triangles."""
        return sum(len(surface.faces) for surface in self.surfaces)


def load_mesh(path: Path, name: str, folder: Path | None = None) -> DrawnMesh:
    """
    Read a mesh; one with too many triangles is simplified.

    Other files that it refers to, such as textures, must be in the folder.

    Parameters
    ----------
    path
        The file.
    name
        The name of the file in error messages.
    folder
        The folder whose files the mesh may use; by default its own folder.

    Returns
    -------
    DrawnMesh
        The mesh, in m.

    Raises
    ------
    MeshError
        The file cannot be read, is too large, or has no triangles.
    OSError
        There is no such file.

    """
    size = path.stat().st_size
    if size > MAX_BYTES:
        raise MeshError(
            f"'{name}' has {size / 1e6:.0f} MB, but the limit is {MAX_BYTES / 1e6:.0f} MB. "
            'Export it with fewer triangles.'
        )
    bodies = [body for body in _bodies(path, name, folder or path.parent) if len(body.faces)]
    if not bodies:
        raise MeshError(f"'{name}' has no triangles.")
    for body in bodies:
        if not np.isfinite(body.vertices).all():
            raise MeshError(f"'{name}' has coordinates that are not finite.")
    count = sum(len(body.faces) for body in bodies)
    is_flat = path.suffix.lower() == '.stl'
    if count <= MAX_TRIANGLES:
        surfaces = map(_surface, bodies)
        return DrawnMesh(tuple(map(creased, surfaces) if is_flat else surfaces))
    return _simplified(bodies, count, is_flat, name)


def _bodies(path: Path, name: str, folder: Path) -> list[Any]:
    """Return the bodies of a file, transformed to the frame of the whole mesh."""
    from rviz_default_plugins.robot.nearby_files import NearbyFiles
    import trimesh

    try:
        with path.open('rb') as stream:
            scene = trimesh.load_scene(
                stream,
                file_type=path.suffix[1:].lower(),
                resolver=NearbyFiles(path, folder),
            )
        if path.suffix.lower() == '.dae':  # the only format that defines its unit
            scene = scene.convert_units('meters')
        return [body for body in scene.dump() if isinstance(body, trimesh.Trimesh)]
    except Exception as error:  # each reader raises its own exceptions
        raise MeshError(f"'{name}' cannot be read: {_first_line(error)}") from error


def _first_line(error: Exception) -> str:
    lines = str(error).splitlines()
    return f'{lines[0] if lines else type(error).__name__}.'


def _surface(body: Any) -> Surface:
    color, is_coloured = _colors(body)
    return Surface(
        np.asarray(body.vertices, np.float32),
        np.asarray(body.faces, np.uint32),
        color,
        body.export(file_type='glb') if is_coloured else None,
        bool(body.is_volume),
    )


def creased(surface: Surface) -> Surface:
    """
    Duplicate the vertices at sharp edges, so that the rest can be shaded smoothly.

    Parameters
    ----------
    surface
        A surface whose triangles share vertices.

    """
    import trimesh

    body = trimesh.Trimesh(surface.vertices, surface.faces, process=False)
    smooth = body.face_adjacency[body.face_adjacency_angles < CREASE_RAD]
    graph: Any = trimesh.graph
    patches = graph.connected_component_labels(smooth, len(body.faces))
    count = int(patches.max()) + 1
    corners, faces = np.unique(body.faces * count + patches[:, None], return_inverse=True)
    return replace(
        surface,
        vertices=surface.vertices[corners // count],
        faces=faces.reshape(-1, 3).astype(np.uint32),
    )


def _colors(body: Any) -> tuple[Color | None, bool]:
    """Return the colour of a body, if any, and whether it has several or a texture."""
    visual = body.visual
    if not visual.defined:
        return None, False
    if visual.kind == 'texture':
        material = visual.material
        images = (getattr(material, name, None) for name in ('image', 'baseColorTexture'))
        has_image = any(image is not None for image in images)
        return _color(material.main_color), has_image and visual.uv is not None
    used = visual.face_colors if visual.kind == 'face' else visual.vertex_colors
    return _color(visual.main_color), bool((used != used[0]).any())


def _color(given: Any) -> Color:
    red, green, blue, opacity = (float(part) / 255.0 for part in given)
    return red, green, blue, opacity


def _simplified(bodies: list[Any], count: int, is_flat: bool, name: str) -> DrawnMesh:
    """Simplify bodies with too many triangles; each keeps its share of the limit."""
    surfaces = []
    for body in bodies:
        share = max(1, len(body.faces) * MAX_TRIANGLES // count)
        whole = np.asarray(body.vertices, np.float32), np.asarray(body.faces, np.uint32)
        surfaces.append(Surface(*thinned(*whole, share), _colors(body)[0]))
    mesh = DrawnMesh(tuple(surfaces), is_flat)
    warning = (
        f"'{name}' has {count} triangles; {mesh.triangle_count} are shown. Export it with fewer, "
        f'at most {MAX_TRIANGLES}.'
    )
    return DrawnMesh(mesh.surfaces, is_flat, warning)


def thinned(vertices: Vertices, faces: Faces, limit: int) -> tuple[Vertices, Faces]:
    """
    Simplify a mesh by vertex clustering: the vertices in each cell of a lattice become one.

    Parameters
    ----------
    vertices
        The vertices (N, 3).
    faces
        The indices of the vertices of each triangle (M, 3).
    limit
        The maximum number of triangles of the result.

    Returns
    -------
    tuple[Vertices, Faces]
        Fewer vertices and triangles, in the same format.

    """
    lowest = vertices.min(axis=0)
    extent = float(np.ptp(vertices, axis=0).max()) or 1.0
    cells = 2 * isqrt(limit) + 1
    while len(faces) > limit and cells > 1:
        lattice = np.floor((vertices - lowest) / extent * cells).astype(np.int64)
        vertices, faces = _merged(vertices, faces, lattice @ np.array(_weights(cells)))
        cells = int(cells * STEP)
    return vertices, faces[:limit]


def _weights(cells: int) -> tuple[int, int, int]:
    """Return the index strides that give each cell a unique number."""
    return 1, cells + 1, (cells + 1) ** 2


def _merged(
    vertices: Vertices, faces: Faces, cell_of: np.ndarray[tuple[int, ...], np.dtype[np.int64]]
) -> tuple[Vertices, Faces]:
    """Merge the vertices of each cell into their mean; drop triangles that collapse."""
    _, cells, counts = np.unique(cell_of, return_inverse=True, return_counts=True)
    cells = cells.ravel()
    sums = [np.bincount(cells, weights=vertices[:, axis]) for axis in range(3)]
    means = (np.stack(sums, axis=1) / counts[:, None]).astype(np.float32)
    moved = cells[faces].astype(np.uint32)
    a, b, c = moved.T
    kept = moved[(a != b) & (b != c) & (a != c)]
    _, first = np.unique(np.sort(kept, axis=1), axis=0, return_index=True)
    return means, kept[np.sort(first)]


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
    files
        The time of the last change, in ns, and the mesh of each file that has been read.
    complaints
        A message for each mesh that is missing, broken or simplified.

    """

    def __init__(self, before: MeshShelf | None = None) -> None:
        self.files: dict[Path, tuple[int, DrawnMesh]] = dict(before.files) if before else {}
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
        known = self.files.get(path)
        if known is None or known[0] != changed_ns:
            known = self.files[path] = changed_ns, load_mesh(path, name, folder_of(name))
        return known[1]
