# SPDX-License-Identifier: Apache-2.0
"""How the bodies of links are drawn, inflated to be visible around others at the same place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, TYPE_CHECKING

import numpy as np
from rviz_common.glb import surface_glb
from rviz_default_plugins.robot.merged_bodies import GREY, merged, primitive, subdivisions
from rviz_default_plugins.robot.mesh_loading import DrawnMesh
from urdf import Box, Capsule, Color, Cylinder, Geometry, Mesh, Shape, Sphere
from urdf.kinematics import rotation_of

if TYPE_CHECKING:
    from viser import SceneApi, SceneNodeHandle

__all__ = ['SOLID', 'draw_bodies', 'draw_shape', 'inflated']

SOLID = 0.5
"""The opacity from which on something has a shadow."""

MESH_SIZE_M = 0.3
"""The assumed size of meshes, whose actual size is only known once they are read."""


def draw_bodies(
    scene: SceneApi,
    path: str,
    bodies: Sequence[tuple[str, Shape]],
    alpha: float,
    meshes: Mapping[str, DrawnMesh],
    tint: Color | None = None,
) -> list[SceneNodeHandle]:
    """
    Draw the bodies of a link, as few nodes.

    Parameters
    ----------
    scene
        The scene of the viser server.
    path
        The path of the link in the scene.
    bodies
        The names and shapes of the bodies.
    alpha, meshes, tint
        As for `draw_shape`.

    Returns
    -------
    list[SceneNodeHandle]
        The nodes that were added.

    """
    together, alone = merged(bodies, meshes, alpha, tint)
    nodes: list[SceneNodeHandle] = []
    for index, body in enumerate(together):
        name = f'{path}/merged_{index}'
        if body.color is None:
            glb = surface_glb(body.vertices, body.faces, body.colors)
            nodes.append(scene.add_glb(name, glb))
        else:
            look = _look(body.color, 1.0)
            nodes.append(scene.add_mesh_simple(name, body.vertices, body.faces, **look))
    for name, shape in alone:
        nodes += draw_shape(scene, f'{path}/{name}', shape, alpha, meshes, tint)
    return nodes


def draw_shape(
    scene: SceneApi,
    path: str,
    shape: Shape,
    alpha: float,
    meshes: Mapping[str, DrawnMesh],
    tint: Color | None = None,
) -> list[SceneNodeHandle]:
    """
    Draw a body of a link, in its own colours or in a tint.

    A mesh that has not been read is left out.

    Parameters
    ----------
    scene
        The scene of the viser server.
    path
        The path of the scene for the body; its origin is relative to the parent node.
    shape
        The body.
    alpha
        The opacity, from 0 to 1, by which that of the colour is multiplied.
    meshes
        The meshes that have been read, by the names in the URDF.
    tint
        The colour that replaces its own colours, None to keep those.

    Returns
    -------
    list[SceneNodeHandle]
        The nodes that were added.

    """
    x, y, z, w = rotation_of(shape.origin.rpy)
    place: dict[str, Any] = {'position': shape.origin.xyz, 'wxyz': (w, x, y, z)}
    body = shape.geometry
    if isinstance(body, Mesh):
        mesh = meshes.get(body.file)
        if mesh is None:
            return []
        return _draw_mesh(scene, path, mesh, body, (tint, shape.color), alpha, place)
    look = _look(tint or shape.color or GREY, alpha)
    if isinstance(body, Box):
        return [scene.add_box(path, dimensions=body.size, **look, **place)]
    if isinstance(body, Sphere):
        return [
            scene.add_icosphere(
                path,
                radius=body.radius,
                subdivisions=subdivisions(body.radius),
                **look,
                **place,
            )
        ]
    if isinstance(body, Cylinder):
        return [scene.add_cylinder(path, radius=body.radius, height=body.length, **look, **place)]
    surface = primitive(body)
    return [scene.add_mesh_simple(path, surface.vertices, surface.faces, **look, **place)]


def _look(color: Color, alpha: float) -> dict[str, Any]:
    """Return colour, shadow and opacity, None if opaque, which is drawn faster."""
    opacity = color[3] * alpha
    return {
        'color': tuple(round(255 * part) for part in color[:3]),
        'opacity': None if opacity >= 1.0 else opacity,
        'cast_shadow': opacity >= SOLID,
    }


def _draw_mesh(
    scene: SceneApi,
    path: str,
    mesh: DrawnMesh,
    body: Mesh,
    colors: tuple[Color | None, Color | None],
    alpha: float,
    place: dict[str, Any],
) -> list[SceneNodeHandle]:
    """Draw a mesh with the colours of its file, without any with the second; or with a tint."""
    tint, color = colors
    is_mirrored = np.prod(body.scale) < 0.0
    nodes: list[SceneNodeHandle] = []
    for index, surface in enumerate(mesh.surfaces):
        name = f'{path}_{index}'
        if surface.glb is not None and alpha >= 1.0 and tint is None:
            nodes.append(scene.add_glb(name, surface.glb, scale=body.scale, **place))
            continue
        nodes.append(
            scene.add_mesh_simple(
                name,
                surface.vertices,
                surface.faces,
                scale=body.scale,
                flat_shading=mesh.is_flat,
                # Twice as fast, or more, without a graphics card.
                side='front' if surface.is_closed and not is_mirrored else 'double',
                **_look(tint or surface.color or color or GREY, alpha),
                **place,
            )
        )
    return nodes


def inflated(shape: Shape, margin_m: float) -> Shape:
    """
    Enlarge a body, so that its whole surface moves outwards by a margin.

    Parameters
    ----------
    shape
        The body. A mesh is scaled as if it were 0.3 m large.
    margin_m
        The margin, in m.

    """
    return replace(shape, geometry=_inflated(shape.geometry, margin_m)) if margin_m else shape


def _inflated(body: Geometry, margin_m: float) -> Geometry:
    if isinstance(body, Box):
        x, y, z = body.size
        return Box((x + 2 * margin_m, y + 2 * margin_m, z + 2 * margin_m))
    if isinstance(body, Cylinder):
        return Cylinder(body.radius + margin_m, body.length + 2 * margin_m)
    if isinstance(body, Capsule):
        return Capsule(body.radius + margin_m, body.length)
    if isinstance(body, Sphere):
        return Sphere(body.radius + margin_m)
    factor = 1.0 + 2 * margin_m / MESH_SIZE_M
    x, y, z = body.scale
    return Mesh(body.file, (x * factor, y * factor, z * factor))
