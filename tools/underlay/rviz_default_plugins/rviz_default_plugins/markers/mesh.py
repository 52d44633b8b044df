# SPDX-License-Identifier: Apache-2.0
"""How the meshes that markers name reach the page."""

from __future__ import annotations

from concurrent.futures import Future
from functools import lru_cache
from pathlib import Path
from threading import Lock, Thread

from rviz_common.canvas import Canvas
from rviz_default_plugins.bodies import opacity_of
from rviz_default_plugins.markers.look import Look
from rviz_default_plugins.robot.mesh_file import find_mesh
from rviz_default_plugins.robot.mesh_loading import DrawnMesh, load_mesh

__all__ = ['MeshIsBeingRead', 'draw_mesh', 'mesh_of']

WHITE = (1.0, 1.0, 1.0, 1.0)
ONE_AT_A_TIME = Lock()


class MeshIsBeingRead(ValueError):
    """The mesh has not been read yet."""


def draw_mesh(canvas: Canvas, name: str, look: Look) -> None:
    """
    Draw the mesh that a marker names, in the colours of its file if the marker wants that.

    The file is read in the background.

    Parameters
    ----------
    canvas
        Where to draw.
    name
        The prefix of the names of the nodes, below the root of the canvas.
    look
        The look of the marker.

    Raises
    ------
    ValueError
        The mesh cannot be found or read.
    MeshIsBeingRead
        It has not been read yet. This is also a ValueError.

    """
    resource, has_own_colors = look.mesh
    if not resource:
        raise ValueError('its mesh_resource is empty.')
    mesh = mesh_of(resource)
    for index, surface in enumerate(mesh.surfaces):
        path = f'{name}_{index}'
        if has_own_colors and surface.glb is not None:
            canvas.put('glb', path, glb_data=surface.glb, scale=look.scale)
            continue
        color, alpha = look.color, look.alpha
        if has_own_colors:
            red, green, blue, alpha = surface.color or WHITE
            color = round(red * 255), round(green * 255), round(blue * 255)
        canvas.put(
            'mesh_simple',
            path,
            vertices=surface.vertices,
            faces=surface.faces,
            color=color,
            opacity=opacity_of(alpha),
            scale=look.scale,
            flat_shading=mesh.is_flat,
            side='double',
        )


def mesh_of(resource: str) -> DrawnMesh:
    """
    Return the mesh that a marker names; the file is read in the background.

    Parameters
    ----------
    resource
        The name of the file.

    Raises
    ------
    ValueError
        The mesh cannot be found or read.
    MeshIsBeingRead
        It has not been read yet. This is also a ValueError.

    """
    path = find_mesh(resource)
    try:
        changed_ns = path.stat().st_mtime_ns
    except OSError as error:
        raise ValueError(f"'{resource}' cannot be read: {error.strerror}.") from None
    reading = _reading(path, resource, changed_ns)
    if not reading.done():
        raise MeshIsBeingRead(f"'{resource}' is being read.")
    return reading.result()


@lru_cache(maxsize=256)
def _reading(path: Path, resource: str, changed_ns: int) -> Future[DrawnMesh]:
    """Start reading a mesh in the background, which may take seconds."""
    reading: Future[DrawnMesh] = Future()

    def read() -> None:
        try:
            with ONE_AT_A_TIME:
                reading.set_result(load_mesh(path, resource))
        except OSError as error:
            reading.set_exception(ValueError(f"'{resource}' cannot be read: {error.strerror}."))
        except Exception as error:  # the exception is passed on to those waiting for the mesh
            reading.set_exception(error)

    Thread(target=read, name='mesh', daemon=True).start()
    return reading
