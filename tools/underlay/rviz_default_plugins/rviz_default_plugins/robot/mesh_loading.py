# SPDX-License-Identifier: Apache-2.0
"""Loading of mesh files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from rviz_default_plugins.robot.mesh import DrawnMesh, Surface
from rviz_default_plugins.robot.mesh_error import MeshError
from rviz_default_plugins.robot.mesh_thinning import thinned
from urdf import Color

__all__ = ['MAX_BYTES', 'MAX_TRIANGLES', 'load_mesh']

MAX_BYTES = 100_000_000
MAX_TRIANGLES = 200_000


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
            f"'{name}' has {size / 1e6:.0f} MB, and at most {MAX_BYTES / 1e6:.0f} MB are shown. "
            'Export it with fewer triangles.'
        )
    bodies = [body for body in _bodies(path, name, folder or path.parent) if len(body.faces)]
    if not bodies:
        raise MeshError(f"'{name}' has no triangles.")
    for body in bodies:
        if not np.isfinite(body.vertices).all():
            raise MeshError(f"'{name}' has coordinates that are no finite numbers.")
    count = sum(len(body.faces) for body in bodies)
    is_flat = path.suffix.lower() == '.stl'
    if count <= MAX_TRIANGLES:
        return DrawnMesh(tuple(map(_surface, bodies)), is_flat)
    return _thinned(bodies, count, is_flat, name)


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


def _thinned(bodies: list[Any], count: int, is_flat: bool, name: str) -> DrawnMesh:
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
