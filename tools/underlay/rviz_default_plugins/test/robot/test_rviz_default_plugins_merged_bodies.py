# SPDX-License-Identifier: Apache-2.0
"""The bodies of a link that are drawn as one: which are, where they are, and how they look."""

from __future__ import annotations

from io import BytesIO
import json
import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from rviz_default_plugins.robot.merged_bodies import merged, subdivisions
from rviz_default_plugins.robot.mesh_loading import DrawnMesh, Surface
from rviz_default_plugins.robot.shape_drawing import draw_bodies
import trimesh
from urdf import Box, Capsule, Color, Cylinder, Geometry, Mesh, Origin, Shape, Sphere

RED: Color = (1.0, 0.0, 0.0, 1.0)
BLUE: Color = (0.0, 0.0, 1.0, 1.0)
SHELL = Mesh('shell.stl')


def shell(**changes: Any) -> dict[str, DrawnMesh]:
    """Return the mesh of a box whose edges are 1, 2 and 3 long."""
    box = trimesh.creation.box((1, 2, 3))
    given: dict[str, Any] = {'is_closed': True, **changes}
    is_flat = given.pop('is_flat', False)
    surface = Surface(np.float32(box.vertices), np.uint32(box.faces), **given)
    return {'shell.stl': DrawnMesh((surface,), is_flat)}


def named(*shapes: Shape) -> list[tuple[str, Shape]]:
    """Return bodies with names."""
    return [(f'visual_{index}', each) for index, each in enumerate(shapes)]


def test_opaque_bodies_are_one() -> None:
    """All opaque bodies of a link are one, each vertex with the colour of its body."""
    bodies = named(Shape(SHELL, color=RED), Shape(Sphere(0.1), color=BLUE))
    (body,), left = merged(bodies, shell(), 1.0)
    assert left == [] and body.color is None
    assert len(body.faces) == 12 + 320
    assert body.colors[:8].tolist() == [[255, 0, 0, 255]] * 8
    assert body.colors[8:].tolist() == [[0, 0, 255, 255]] * 162
    assert trimesh.Trimesh(body.vertices, body.faces).volume == pytest.approx(6.004, abs=1e-3)


def test_translucent_bodies_are_one_of_each_colour() -> None:
    """Translucent bodies of one colour are one, and a tint makes all of one colour."""
    bodies = named(
        Shape(SHELL, color=RED), Shape(Sphere(0.1), color=BLUE), Shape(SHELL, color=RED)
    )
    found, left = merged(bodies, shell(), 0.5)
    assert [each.color for each in found] == [(*RED[:3], 0.5), (*BLUE[:3], 0.5)]
    assert [len(each.faces) for each in found] == [24, 320]
    assert left == []
    (body,), left = merged(bodies, shell(), 0.5, (0.0, 1.0, 0.0, 1.0))
    assert (body.color, len(body.faces)) == ((0.0, 1.0, 0.0, 0.5), 344)


@pytest.mark.parametrize('mirror', [1.0, -1.0])
def test_places(mirror: float) -> None:
    """A body is where its origin says, outside out also when a scale mirrors it."""
    place = Origin((1.0, 0.0, 0.0), (0.0, 0.0, math.pi / 2))
    far = Shape(Mesh('shell.stl', (0.1, 0.1, mirror)), place)
    (body,), _ = merged(named(far, far), shell(), 1.0)
    assert body.vertices.min(axis=0) == pytest.approx([0.9, -0.05, -1.5])
    assert body.vertices.max(axis=0) == pytest.approx([1.1, 0.05, 1.5])
    assert trimesh.Trimesh(body.vertices, body.faces).volume == pytest.approx(2 * 0.06)


@pytest.mark.parametrize(
    ('shape', 'size', 'volume'),
    [
        (Box((0.1, 0.2, 0.3)), (0.1, 0.2, 0.3), 0.006),
        (Cylinder(0.1, 0.4), (0.2, 0.2, 0.4), math.pi * 0.004),
        (Capsule(0.1, 0.4), (0.2, 0.2, 0.6), math.pi * (0.004 + 0.004 / 3)),
        (Sphere(0.2), (0.4, 0.4, 0.4), math.pi * 0.032 / 3),
    ],
)
def test_primitives(shape: Geometry, size: tuple[float, float, float], volume: float) -> None:
    """Other bodies are merged with a mesh in their sizes, centred."""
    (body,), _ = merged(named(Shape(SHELL), Shape(shape)), shell(), 1.0)
    vertices = body.vertices[8:]
    assert vertices.max(axis=0) - vertices.min(axis=0) == pytest.approx(size, rel=0.02)
    assert vertices.max(axis=0) + vertices.min(axis=0) == pytest.approx([0, 0, 0], abs=1e-6)
    drawn = trimesh.Trimesh(vertices, body.faces[12:] - 8)
    assert drawn.volume == pytest.approx(volume, rel=0.03)


@pytest.mark.parametrize(
    ('shapes', 'changes'),
    [
        ((Shape(SHELL),), {}),
        ((Shape(Sphere(1.0)), Shape(Sphere(1.0))), {}),
        ((Shape(SHELL), Shape(Sphere(0.0))), {}),
        ((Shape(SHELL), Shape(Mesh('missing.stl'))), {}),
        ((Shape(SHELL), Shape(SHELL)), {'is_closed': False}),
        ((Shape(SHELL), Shape(SHELL)), {'is_flat': True}),
        ((Shape(SHELL), Shape(SHELL)), {'glb': b'textured'}),
    ],
)
def test_bodies_that_are_left(shapes: tuple[Shape, ...], changes: dict[str, Any]) -> None:
    """What cannot be merged, or need not be, is left as it is."""
    bodies = named(*shapes)
    assert merged(bodies, shell(**changes), 1.0) == ([], bodies)


def test_some_bodies_are_left() -> None:
    """A body that cannot be merged does not keep the others from it."""
    bodies = named(Shape(SHELL), Shape(Mesh('missing.stl')), Shape(Sphere(0.1)))
    (_,), left = merged(bodies, shell(), 1.0)
    assert left == bodies[1:2]


def test_textures_are_lost_in_a_tint() -> None:
    """A body with a texture is merged if it is drawn without it."""
    (body,), left = merged(named(Shape(SHELL), Shape(SHELL)), shell(glb=b'textured'), 1.0, RED)
    assert (body.color, left) == (RED, [])


def test_spheres_are_as_fine_as_they_are_large() -> None:
    """A small sphere has fewer triangles."""
    assert [subdivisions(radius_m) for radius_m in (0.05, 1.0)] == [2, 3]


def colors_of(glb: bytes) -> Any:
    """Return the colours in a GLB file, which the reader that checks the rest leaves out."""
    size = int.from_bytes(glb[12:16], 'little')
    content = json.loads(glb[20 : 20 + size])
    [mesh] = content['meshes']
    index = mesh['primitives'][0]['attributes']['COLOR_0']
    view = content['bufferViews'][content['accessors'][index]['bufferView']]
    start = 20 + size + 8 + view['byteOffset']
    return np.frombuffer(glb[start : start + view['byteLength']], np.uint16).reshape(-1, 4)


def test_drawing() -> None:
    """A body of several colours is a GLB file, one of a single colour a mesh."""
    drawn: list[tuple[Any, ...]] = []
    scene: Any = SimpleNamespace(
        add_glb=lambda *args: drawn.append(args) or 'glb',
        add_mesh_simple=lambda *args, **look: drawn.append((*args, look)) or 'mesh',
    )
    bodies = named(Shape(SHELL, color=RED), Shape(Sphere(0.1), color=BLUE))
    assert draw_bodies(scene, '/link', bodies, 1.0, shell()) == ['glb']
    path, glb = drawn.pop()
    (read,) = trimesh.load_scene(BytesIO(glb), file_type='glb', process=False).dump()
    assert path == '/link/merged_0'
    assert colors_of(glb)[[0, 8]].tolist() == [[65535, 0, 0, 65535], [0, 0, 65535, 65535]]
    assert read.vertex_normals[8:] == pytest.approx(read.vertices[8:] / 0.1, abs=0.01)
    assert (read.is_volume, read.volume) == (True, pytest.approx(6.004, abs=1e-3))
    assert draw_bodies(scene, '/link', bodies, 0.5, shell(), RED) == ['mesh']
    look = drawn.pop()[-1]
    assert look == {'color': (255, 0, 0), 'opacity': 0.5, 'cast_shadow': True}
