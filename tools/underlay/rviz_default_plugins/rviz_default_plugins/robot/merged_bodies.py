# SPDX-License-Identifier: Apache-2.0
"""How the bodies of a link become few meshes: a browser takes time for each, however small."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import astuple, dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from rviz_default_plugins.decoding.geometry import rotated
from rviz_default_plugins.robot.mesh_loading import creased, DrawnMesh, Surface
from urdf import Box, Capsule, Color, Cylinder, Geometry, Mesh, Shape, Sphere
from urdf.kinematics import rotation_of

__all__ = ['GREY', 'MergedBody', 'merged', 'primitive', 'subdivisions']

GREY: Color = (0.7, 0.7, 0.7, 1.0)
"""The colour of bodies without one."""

SMALL_M = 0.15
"""The radius up to which a sphere looks round with a quarter of the triangles."""


@dataclass(frozen=True)
class MergedBody:
    """
    Closed surfaces in the frame of a link, with the colour of each vertex.

    `color` is that of all vertices, None if they have several; such a body is opaque.
    """

    vertices: NDArray[np.float32]
    faces: NDArray[np.uint32]
    colors: NDArray[np.uint8]
    color: Color | None


def merged(
    bodies: Sequence[tuple[str, Shape]],
    meshes: Mapping[str, DrawnMesh],
    alpha: float,
    tint: Color | None = None,
) -> tuple[list[MergedBody], list[tuple[str, Shape]]]:
    """
    Merge the bodies of a link: the opaque ones, and of the translucent ones those of each colour.

    A link whose bodies are one surface, or no meshes, is left as it is; and so are bodies with
    several colours or a texture, and those of which the inside can be seen.

    Parameters
    ----------
    bodies
        The names and shapes of the bodies.
    meshes
        The meshes that have been read, by the names in the URDF.
    alpha
        The opacity, from 0 to 1, by which that of the colours is multiplied.
    tint
        The colour that replaces all others, None to keep those.

    Returns
    -------
    tuple[list[MergedBody], list[tuple[str, Shape]]]
        The merged bodies, and the names and shapes of the bodies that are left.

    """
    is_plain = alpha < 1.0 or tint is not None
    found = [(shape, _surfaces(shape.geometry, meshes, is_plain)) for _, shape in bodies]
    surfaces = [(shape, surface) for shape, each in found for surface in each]
    if len(surfaces) < 2 or not any(isinstance(shape.geometry, Mesh) for shape, _ in surfaces):
        return [], list(bodies)
    groups: dict[Color | None, list[tuple[Surface, Color]]] = {}
    for shape, surface in surfaces:
        color = tint or surface.color or shape.color or GREY
        seen = *color[:3], color[3] * alpha
        group = groups.setdefault(None if seen[3] >= 1.0 else seen, [])
        group.append((_placed(surface, shape), seen))
    left = [body for body, (_, each) in zip(bodies, found) if not each]
    return [_joined(each) for each in groups.values()], left


def subdivisions(radius_m: float) -> int:
    """
    Choose how finely a sphere is divided into triangles.

    Parameters
    ----------
    radius_m
        Its radius.

    Returns
    -------
    int
        How many times the triangles of an icosahedron are divided by four.

    """
    return 2 if radius_m <= SMALL_M else 3


@lru_cache(maxsize=100)
def primitive(body: Box | Capsule | Cylinder | Sphere) -> Surface:
    """
    Compute the triangles of a body that is no mesh, centred, with sharp edges.

    Parameters
    ----------
    body
        The body; its sizes are above 0.

    """
    from trimesh import creation

    if isinstance(body, Box):
        mesh = creation.box(body.size)
    elif isinstance(body, Sphere):
        mesh = creation.icosphere(subdivisions(body.radius), body.radius)
    elif isinstance(body, Cylinder):
        mesh = creation.cylinder(body.radius, body.length)
    else:
        mesh = creation.capsule(body.length, body.radius)
        mesh.apply_translation(-mesh.bounds.mean(axis=0))
    vertices = np.asarray(mesh.vertices, np.float32)
    surface = Surface(vertices, np.asarray(mesh.faces, np.uint32), is_closed=True)
    return creased(surface) if isinstance(body, (Box, Cylinder)) else surface


def _surfaces(
    body: Geometry, meshes: Mapping[str, DrawnMesh], is_plain: bool
) -> tuple[Surface, ...]:
    """Return the surfaces of a body that can be merged, if all can; without textures if plain."""
    if not isinstance(body, Mesh):
        return (primitive(body),) if np.ravel(astuple(body)).min() > 0.0 else ()
    mesh = meshes.get(body.file)
    if mesh is None or mesh.is_flat or not np.prod(body.scale):
        return ()
    can_merge = all(each.is_closed and (is_plain or each.glb is None) for each in mesh.surfaces)
    return mesh.surfaces if can_merge else ()


def _placed(surface: Surface, shape: Shape) -> Surface:
    """Return a surface of a body in the frame of the link; a mirror turns its triangles over."""
    body, origin = shape.geometry, shape.origin
    scale = np.array(body.scale if isinstance(body, Mesh) else (1.0, 1.0, 1.0))
    x, y, z, w = rotation_of(origin.rpy)
    vertices = rotated(surface.vertices * scale, (w, x, y, z)) + np.array(origin.xyz)
    faces = surface.faces if np.prod(scale) > 0.0 else surface.faces[:, ::-1]
    return Surface(vertices.astype(np.float32), faces)


def _joined(parts: Sequence[tuple[Surface, Color]]) -> MergedBody:
    """Return surfaces as one."""
    starts = np.cumsum([0, *(len(surface.vertices) for surface, _ in parts)])
    faces = [surface.faces + start for (surface, _), start in zip(parts, starts)]
    colors = [
        np.tile(np.array(color) * 255.0, (len(surface.vertices), 1)) for surface, color in parts
    ]
    used = {color for _, color in parts}
    return MergedBody(
        np.concatenate([surface.vertices for surface, _ in parts]),
        np.concatenate(faces).astype(np.uint32),
        np.concatenate(colors).round().astype(np.uint8),
        used.pop() if len(used) == 1 else None,
    )
