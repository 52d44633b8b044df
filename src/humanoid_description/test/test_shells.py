# SPDX-License-Identifier: Apache-2.0
"""Check what the humanoid looks like, and that this does not change how it moves."""

from __future__ import annotations

from collections.abc import Callable
import hashlib
from pathlib import Path
import re
from typing import Any
from xml.etree import ElementTree

from humanoid_description.checks.mirror import look_at_mirror
from humanoid_description.checks.shells import look_at_shells
from humanoid_description.errors import DescriptionError
from humanoid_description.expansion import humanoid_urdf, load_config
from humanoid_description.loading import load_robot
from humanoid_description.mesh_files import bounds
from humanoid_description.robot import Shape
import numpy as np
import pytest

Element = ElementTree.Element

# Of the URDF without visuals and colours. A change of lengths, masses, joints or collisions
# changes them; what the robot looks like must not.
DIGESTS: dict[str, tuple[dict[str, Any], str]] = {
    'whole': ({}, '1880267b024abe7cc97c5bbd8ef51e59cf60431939976e34cbaf074c71ac0cb4'),
    'small, with hands': (
        {'scale': 0.65, 'hands': True},
        'b3ffcb95ee977ee0e3fcc0e959e99f691d3e0098626cb0e766f67345a55e6a89',
    ),
    'upper body': (
        {'prefix': 'r1_', 'upper_body_only': True},
        '095d2167b8f7471a2cb5333390c18acbc815915d9f518ceadf626d199677c1fd',
    ),
}


def without_looks(urdf: str) -> str:
    """Return a URDF without visuals and materials, in a canonical form."""
    robot = ElementTree.fromstring(urdf)
    for link in robot.findall('link'):
        for visual in link.findall('visual'):
            link.remove(visual)
    for material in robot.findall('material'):
        robot.remove(material)
    text = ElementTree.tostring(robot, encoding='unicode')
    return ElementTree.canonicalize(text, strip_text=True)


@pytest.mark.parametrize('name', DIGESTS)
def test_physics_is_what_it_was_with_boxes(name: str) -> None:
    """Masses, inertia, joints and collisions are those of the model before it had shells."""
    arguments, digest = DIGESTS[name]
    text = without_looks(humanoid_urdf(**arguments))
    assert hashlib.sha256(text.encode()).hexdigest() == digest


def test_collisions_are_primitives(robot: Element) -> None:
    """No link collides with a mesh, and each that collides is seen."""
    solid = robot.findall('link/collision/geometry/*')
    assert solid
    assert {shape.tag for shape in solid} == {'box', 'cylinder'}
    for link in robot.findall('link'):
        assert link.find('collision') is None or link.find('visual') is not None


def test_colours(urdf: str) -> None:
    """The schemes differ in the colours of the same materials, and in nothing else."""
    dark = humanoid_urdf(colours='dark')
    assert without_looks(dark) == without_looks(urdf)
    schemes = load_config('colours.yaml')
    assert list(schemes) == ['light', 'dark']
    for name, text in (('light', urdf), ('dark', dark)):
        robot = ElementTree.fromstring(text)
        colours = {each.attrib['name']: each.find('color') for each in robot.findall('material')}
        assert {each.attrib['name'] for each in robot.findall('link/visual/material')} == set(
            colours
        )
        for material, colour in colours.items():
            assert colour is not None
            assert colour.attrib['rgba'] == f'{schemes[name][material]} 1.0'


def test_no_such_colours() -> None:
    """An unknown scheme is refused, with the names of those that there are."""
    with pytest.raises(DescriptionError, match=r'no colour scheme pink\. Give light or dark'):
        humanoid_urdf(colours='pink')


def test_face_is_in_front(robot: Element) -> None:
    """Both eyes are in front of the head, beside each other, and behind the camera."""
    model = load_robot(ElementTree.tostring(robot, encoding='unicode'), 'the humanoid')
    shapes = model.link['head'].visuals
    eyes = [shape for shape in shapes if shape.file.endswith('/eye.stl')]
    right, left = sorted(boxes_of(eyes), key=lambda box: float(box[0, 1]))
    camera_m = model.joint['camera_link_fixed'].pose[0, 3]
    assert right[1, 1] < 0.0 < left[0, 1]
    for eye in (right, left):
        assert 0.9 * camera_m < eye[1, 0] < camera_m


@pytest.mark.parametrize('joint', ['knee', 'elbow'])
def test_joints_are_closed(joint: str, robot: Element) -> None:
    """A ball at the joint is larger than the ends of both shells, wherever the joint is."""
    model = load_robot(ElementTree.tostring(robot, encoding='unicode'), 'the humanoid')
    at = model.joint[f'left_{joint}']
    balls = [shape for shape in model.link[at.parent].visuals if shape.kind == 'sphere']
    [ball] = [ball for ball in balls if np.allclose(ball.pose[:3, 3], at.pose[:3, 3])]
    radius = ball.size_m[0]
    [upper] = [shape for shape in model.link[at.parent].visuals if shape.kind == 'mesh']
    lower = next(shape for shape in model.link[at.child].visuals if shape.kind == 'mesh')
    [above], [below] = boxes_of([upper]), boxes_of([lower])
    assert 0.0 < above[0, 2] - at.pose[2, 3] < radius
    assert -radius < below[1, 2] < 0.0


def boxes_of(shapes: list[Shape]) -> list[Any]:
    """Return the bounding boxes of shapes, which must be known."""
    boxes = [bounds(shape, np.eye(4), Path()) for shape in shapes]
    assert all(box is not None for box in boxes)
    return boxes


def far_off(robot: Element) -> None:
    """Put the shell of a shank beside the leg."""
    origin(robot, 'left_shank').set('xyz', '0.5 0 0')


def too_wide(robot: Element) -> None:
    """Double the size of the shell of a shank."""
    mesh = robot.find("link[@name='left_shank']/visual/geometry/mesh")
    assert mesh is not None
    mesh.set('scale', '4 4 1')


def origin(robot: Element, link: str) -> Element:
    """Return the origin of the first visual of a link."""
    found = robot.find(f"link[@name='{link}']/visual/origin")
    assert found is not None
    return found


@pytest.mark.parametrize(
    ('break_it', 'by'), [(far_off, 'do not overlap'), (too_wide, r'extend 1\d\d mm')]
)
def test_shell_that_does_not_fit(break_it: Callable[[Element], None], by: str, urdf: str) -> None:
    """A shell that is not where its link collides is a defect of that link alone."""
    robot = ElementTree.fromstring(urdf)
    break_it(robot)
    _, defects = look_at_shells(load_robot(ElementTree.tostring(robot, encoding='unicode'), 'it'))
    [defect] = defects
    assert "Link 'left_shank' has visual shapes that " in defect
    assert re.search(by, defect)


def test_shell_that_is_not_mirrored(urdf: str) -> None:
    """A shell that is elsewhere on the other side is a defect."""
    robot = ElementTree.fromstring(urdf)
    origin(robot, 'right_shank').set('xyz', '0 0.01 0')
    _, defects = look_at_mirror(load_robot(ElementTree.tostring(robot, encoding='unicode'), 'it'))
    assert list(defects) == [
        "Links 'left_shank' and 'right_shank' do not have mirrored visual shapes."
    ]


def test_mesh_of_another_size(tmp_path: Path) -> None:
    """The scale of a mesh counts; a file that is no binary STL has no bounds."""
    shell = 'package://humanoid_description/meshes/finger.stl'
    box = bounds(Shape('mesh', (2.0, 1.0, 1.0), np.eye(4), shell), np.eye(4), tmp_path)
    assert box is not None
    assert box == pytest.approx(np.array([[-0.024, -0.006, -0.075], [0.024, 0.006, 0.0]]))
    (tmp_path / 'a.stl').write_text('solid a\nendsolid a\n')
    for file in ('a.stl', 'nothing.stl', 'https://example.org/a.stl'):
        assert bounds(Shape('mesh', (1.0, 1.0, 1.0), np.eye(4), file), np.eye(4), tmp_path) is None
