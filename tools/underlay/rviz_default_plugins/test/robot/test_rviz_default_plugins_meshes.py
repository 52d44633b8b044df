# SPDX-License-Identifier: Apache-2.0
"""Files of meshes: which are found, which are refused, and how they are drawn."""

from __future__ import annotations

from collections.abc import Iterator
import os
from pathlib import Path
import shutil
from typing import Any

import numpy as np
from PIL import Image
import pytest
from rviz_default_plugins.displays.robot_model import RobotModel
from rviz_default_plugins.robot import mesh_loading
from rviz_default_plugins.robot.mesh_file import find_mesh, MeshError
from rviz_default_plugins.robot.mesh_loading import load_mesh, MeshShelf, thinned
from stage import sentence, Stage
import trimesh

DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 100 0 0 0 200 0</float_array>
<technique_common><accessor source="#a" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene>
</COLLADA>"""


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Install a package with a mesh; return its share directory."""
    index = tmp_path / 'share/ament_index/resource_index/packages'
    index.mkdir(parents=True)
    (index / 'parts').write_text('')
    share = tmp_path / 'share/parts'
    (share / 'meshes').mkdir(parents=True)
    trimesh.creation.box((1, 2, 3)).export(share / 'meshes/box.stl')
    monkeypatch.setenv('AMENT_PREFIX_PATH', f'{tmp_path}:{os.environ["AMENT_PREFIX_PATH"]}')
    return share


def test_package(package: Path) -> None:
    """A mesh is found in its package, by its path and by a file address."""
    path = package / 'meshes/box.stl'
    for name in ('package://parts/meshes/box.stl', f'file://{path}', str(path)):
        assert find_mesh(name) == path


def test_symbolic_links(package: Path, tmp_path: Path) -> None:
    """A part of a package may be a link out of it: colcon installs with such ones."""
    source = tmp_path / 'src'
    shutil.move(package / 'meshes', source)
    (package / 'meshes').symlink_to(source)
    assert find_mesh('package://parts/meshes/box.stl').is_file()


@pytest.mark.parametrize(
    ('name', 'reason'),
    [
        ('package://parts/../../secret.stl', "is outside of package 'parts'"),
        ('package://parts/%2e%2e/secret.stl', "is outside of package 'parts'"),
        ('package://parts//etc/secret.stl', "is outside of package 'parts'"),
        ('package://part/meshes/box.stl', "not installed. Did you mean 'parts'?"),
        ('package://../x.stl', 'not installed'),
        ('package://parts/meshes/boks.stl', "Did you mean 'box.stl'?"),
        ('package://parts/meshes', 'a format that cannot be shown; supported are .stl'),
        ('/etc/passwd', 'a format that cannot be shown'),
        ('/dev/null/x.stl', 'is not a file'),
        ('http://evil.example/box.stl', 'is not fetched'),
        ('https://evil.example/box.stl', 'is not fetched'),
        ('file://other/box.stl', "on the machine 'other'"),
        ('box.stl', 'Write package://PACKAGE/box.stl'),
        ('', 'is not an absolute path or URL'),
        (f'/{"x" * 5000}.stl', 'cannot be read: File name too long'),
        ('file://[::1/box.stl', 'is not a valid address'),
    ],
)
def test_refused_names(package: Path, name: str, reason: str) -> None:
    """What is elsewhere, or outside of its package, is refused with the reason."""
    with pytest.raises(MeshError) as error:
        find_mesh(name)
    assert reason in str(error.value)


@pytest.mark.parametrize('kind', ['stl', 'obj', 'glb', 'ply'])
def test_kinds(tmp_path: Path, kind: str) -> None:
    """Each kind of file gives the same triangles."""
    path = tmp_path / f'box.{kind}'
    trimesh.creation.box((1, 2, 3)).export(path)
    mesh = load_mesh(path, 'box')
    assert mesh.triangle_count == 12
    assert np.ptp(mesh.surfaces[0].vertices, axis=0).tolist() == [1.0, 2.0, 3.0]


def test_edges_of_stl_stay_sharp(tmp_path: Path) -> None:
    """Smooth parts of an STL file share vertices, and those at sharp edges are separate."""
    trimesh.creation.box((1, 2, 3)).export(tmp_path / 'box.stl')
    trimesh.creation.icosphere(subdivisions=3).export(tmp_path / 'ball.stl')
    box, ball = (load_mesh(tmp_path / f'{name}.stl', name) for name in ('box', 'ball'))
    assert not (box.is_flat or ball.is_flat)
    assert len(box.surfaces[0].vertices) == 6 * 4
    assert len(ball.surfaces[0].vertices) == 642
    for mesh in (box, ball):
        [surface] = mesh.surfaces
        shape = trimesh.Trimesh(surface.vertices, surface.faces, process=True)
        assert shape.is_watertight


@pytest.mark.parametrize(('kept', 'is_closed'), [(12, True), (11, False)])
def test_closed_surfaces(tmp_path: Path, kept: int, is_closed: bool) -> None:
    """Of a box without one of its triangles, the inside can be seen."""
    box = trimesh.creation.box((1, 2, 3))
    trimesh.Trimesh(box.vertices, box.faces[:kept]).export(tmp_path / 'box.stl')
    (surface,) = load_mesh(tmp_path / 'box.stl', 'box.stl').surfaces
    assert surface.is_closed == is_closed


def test_collada(tmp_path: Path) -> None:
    """A file that says its unit is shown in metres."""
    path = tmp_path / 'triangle.dae'
    path.write_text(DAE)
    mesh = load_mesh(path, 'triangle')
    assert np.ptp(mesh.surfaces[0].vertices, axis=0) == pytest.approx([1.0, 2.0, 0.0])


def test_colors(tmp_path: Path) -> None:
    """A body of one colour has it; one of several is drawn as the file says."""
    one, many = trimesh.creation.box(), trimesh.creation.box()
    one.visual.face_colors = (255, 0, 0, 255)
    many.visual.vertex_colors = np.arange(32).reshape(8, 4) * 8
    one.export(tmp_path / 'one.ply')
    many.export(tmp_path / 'many.ply')
    surface = load_mesh(tmp_path / 'one.ply', 'one').surfaces[0]
    assert (surface.color, surface.glb) == ((1.0, 0.0, 0.0, 1.0), None)
    assert load_mesh(tmp_path / 'many.ply', 'many').surfaces[0].glb


def test_textures(tmp_path: Path) -> None:
    """A body with a picture is drawn with it."""
    body = trimesh.creation.box()
    picture = Image.new('RGB', (2, 2), (0, 255, 0))
    body.visual = trimesh.visual.TextureVisuals(uv=np.zeros((8, 2)), image=picture)
    body.export(tmp_path / 'box.glb')
    assert load_mesh(tmp_path / 'box.glb', 'box').surfaces[0].glb


@pytest.mark.parametrize(
    ('picture', 'is_used'),
    [('../pictures/red.png', True), ('../../outside.png', False), ('/etc/hostname', False)],
)
def test_pictures_of_packages(package: Path, picture: str, is_used: bool) -> None:
    """A mesh may use pictures of its package, which may be links out of it; no others."""
    (package / 'pictures').mkdir()
    outside = package.parent / 'outside.png'
    Image.new('RGB', (2, 2), (255, 0, 0)).save(outside)
    (package / 'pictures/red.png').symlink_to(outside)
    (package / 'meshes/body.mtl').write_text(f'newmtl red\nmap_Kd {picture}\n')
    (package / 'meshes/body.obj').write_text(
        'mtllib body.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\n'
        'vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n'
    )
    name, shelf = 'package://parts/meshes/body.obj', MeshShelf()
    shelf.read([name])
    assert bool(shelf.meshes[name].surfaces[0].glb) == is_used


@pytest.mark.parametrize('kind', ['stl', 'obj', 'glb', 'gltf', 'ply', 'dae'])
@pytest.mark.parametrize('content', [b'', b'\x00' * 100, b'solid', b'{}', b'<a/>', b'\xff' * 50])
def test_broken_files(tmp_path: Path, kind: str, content: bytes) -> None:
    """A file that is broken is refused with a sentence, whatever is in it."""
    path = tmp_path / f'broken.{kind}'
    path.write_bytes(content)
    with pytest.raises(MeshError, match="'broken'"):
        load_mesh(path, 'broken')


def test_infinite_coordinates(tmp_path: Path) -> None:
    """A mesh that is nowhere is refused."""
    path = tmp_path / 'nan.obj'
    path.write_text('v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n')
    with pytest.raises(MeshError):
        load_mesh(path, 'nan')


def test_huge_file(tmp_path: Path) -> None:
    """A file that would take minutes to read is not read."""
    path = tmp_path / 'huge.stl'
    with path.open('wb') as stream:
        stream.truncate(mesh_loading.MAX_BYTES + 1)
    with pytest.raises(MeshError, match='but the limit is 100 MB'):
        load_mesh(path, 'huge')


def test_thinning() -> None:
    """A thinned mesh has at most as many triangles as it may, and the same outline."""
    ball = trimesh.creation.icosphere(subdivisions=5)
    vertices, faces = thinned(
        np.asarray(ball.vertices, np.float32), np.asarray(ball.faces, np.uint32), 2000
    )
    assert 500 < len(faces) <= 2000
    assert faces.max() < len(vertices)
    assert np.linalg.norm(vertices, axis=1) == pytest.approx(1.0, abs=0.05)


def test_large_mesh(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A mesh with too many triangles is thinned out, and says so with both numbers."""
    monkeypatch.setattr(mesh_loading, 'MAX_TRIANGLES', 1000)
    path = tmp_path / 'ball.stl'
    trimesh.creation.icosphere(subdivisions=4).export(path)
    mesh = load_mesh(path, 'ball')
    assert mesh.triangle_count <= 1000
    assert mesh.warning.startswith(f"'ball' has 5120 triangles; {mesh.triangle_count} are shown.")


def test_shelf(package: Path) -> None:
    """A file is read once, and again when it has changed."""
    name, path = 'package://parts/meshes/box.stl', package / 'meshes/box.stl'
    first = MeshShelf()
    first.read([name, name])
    second = MeshShelf(first)
    second.read([name])
    assert second.meshes[name] is first.meshes[name]
    trimesh.creation.box((9, 9, 9)).export(path)
    os.utime(path, (1, 1))
    third = MeshShelf(second)
    third.read([name])
    assert np.ptp(third.meshes[name].surfaces[0].vertices) == 9.0


def robot(*files: str) -> str:
    """Return a robot of one link with meshes."""
    visuals = ''.join(
        f'<visual><geometry><mesh filename="{file}" scale="2 2 2"/></geometry>'
        '<material name="m"><color rgba="0 1 0 1"/></material></visual>'
        for file in files
    )
    return f'<robot name="r"><link name="l">{visuals}</link></robot>'


def test_robot_with_meshes(stage: Stage, package: Path) -> None:
    """The meshes that can be read are drawn, with a sentence for each of the others."""
    display: Any = stage.show(RobotModel)
    stage.describe(robot('package://parts/meshes/box.stl', 'http://evil.example/x.stl'))
    stage.work_until(lambda: stage.node_at('/display_0/l/visual_0_0') is not None)
    node = stage.node_at('/display_0/l/visual_0_0')
    assert (node.color, node.scale) == ((0, 255, 0), (2.0, 2.0, 2.0))
    assert 'is not fetched' in sentence(display, 'Meshes')


def test_robot_that_goes_while_its_meshes_are_read(stage: Stage, package: Path) -> None:
    """Meshes that come too late are not drawn."""
    display: Any = stage.show(RobotModel)
    stage.describe(robot('package://parts/meshes/box.stl'))
    stage.describe('<robot name="r"><link name="other"/></robot>')
    posted: list[bool] = []
    stage.context.queue.post(lambda: posted.append(True))
    stage.work_until(lambda: posted)
    display.update()
    assert stage.node_at('/display_0/other') is not None
    assert stage.node_at('/display_0/l') is None
