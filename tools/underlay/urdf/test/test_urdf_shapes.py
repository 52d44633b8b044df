# SPDX-License-Identifier: Apache-2.0
"""The bodies of links, and with which sentence broken ones are refused."""

from __future__ import annotations

import pytest
from urdf import Box, Capsule, Cylinder, Mesh, Origin, parse_urdf, Shape, Sphere, UrdfError

LINK = """<robot name="r">
<material name="blue"><color rgba="0 0 1 0.5"/></material>
<link name="base">
{}
</link>
</robot>"""


def visuals(text: str) -> tuple[Shape, ...]:
    """Return the visuals of a link with this content."""
    return parse_urdf(LINK.format(text)).links[0].visuals


def visual(geometry: str, more: str = '') -> str:
    """Return the element of a visual, on one line."""
    return f'<visual>{more}<geometry>{geometry}</geometry></visual>'


@pytest.mark.parametrize(
    ('text', 'geometry'),
    [
        ('<box size="1 2 3"/>', Box((1.0, 2.0, 3.0))),
        ('<cylinder radius="0.1" length="2"/>', Cylinder(0.1, 2.0)),
        ('<capsule radius="0.1" length="2"/>', Capsule(0.1, 2.0)),
        ('<sphere radius="0.5"/>', Sphere(0.5)),
        ('<mesh filename="package://p/m.stl"/>', Mesh('package://p/m.stl')),
        ('<mesh filename="a.obj" scale="1 2 3"/>', Mesh('a.obj', (1.0, 2.0, 3.0))),
    ],
)
def test_geometry(text: str, geometry: object) -> None:
    """Each kind of geometry is read with its measures."""
    assert visuals(visual(text))[0] == Shape(geometry)


def test_origin_and_order() -> None:
    """A link has its bodies in the order of the file, each with its origin."""
    first = visual('<sphere radius="1"/>', '<origin xyz="1 2 3" rpy="0 0 1"/>')
    shapes = visuals(first + visual('<sphere radius="2"/>'))
    assert [shape.geometry for shape in shapes] == [Sphere(1.0), Sphere(2.0)]
    assert shapes[0].origin == Origin((1.0, 2.0, 3.0), (0.0, 0.0, 1.0))


def test_collisions_are_separate() -> None:
    """What a link collides with is not what it looks like."""
    robot = parse_urdf(
        LINK.format('<collision><geometry><sphere radius="1"/></geometry></collision>')
    )
    assert robot.links[0].visuals == ()
    assert robot.links[0].collisions == (Shape(Sphere(1.0)),)


@pytest.mark.parametrize(
    ('material', 'color'),
    [
        ('<material name="blue"/>', (0.0, 0.0, 1.0, 0.5)),
        ('<material name="own"><color rgba="1 0 0 1"/></material>', (1.0, 0.0, 0.0, 1.0)),
        ('<material name="nobody_knows"/>', None),
        ('<material name=""><color rgba="0 2 0 -1"/></material>', (0.0, 1.0, 0.0, 0.0)),
        ('', None),
    ],
)
def test_color(material: str, color: object) -> None:
    """A material has a colour of its own, or one that the robot defines."""
    assert visuals(visual('<sphere radius="1"/>', material))[0].color == color


def test_color_of_another_link() -> None:
    """A material that one link defines is there for the others."""
    own = '<material name="red"><color rgba="1 0 0 1"/></material>'
    shapes = visuals(
        visual('<sphere radius="1"/>', '<material name="red"/>')
        + visual('<sphere radius="1"/>', own)
    )
    assert shapes[0].color == (1.0, 0.0, 0.0, 1.0)


@pytest.mark.parametrize(
    ('text', 'sentence'),
    [
        ('<box/>', "There is no attribute 'size' in <box> of <visual> of link 'base'. Add it."),
        ('<box size="1 2"/>', "is '1 2', but must be three numbers"),
        ('<box size="1 -2 1"/>', 'is negative: 1 -2 1'),
        ('<cylinder radius="1"/>', "no attribute 'length' in <cylinder>"),
        ('<cylinder radius="-1" length="1"/>', "'radius' in <cylinder>"),
        ('<sphere radius="nan"/>', 'must be a number'),
        ('<mesh/>', "no attribute 'filename' in <mesh>"),
        (
            '<spere radius="1"/>',
            'is not a geometry. There are <box>, <capsule>, <cylinder>, <mesh>, ',
        ),
        ('<spere radius="1"/>', "Did you mean 'sphere'?"),
        ('', "<geometry> in <visual> of link 'base' is empty."),
    ],
)
def test_broken_geometry(text: str, sentence: str) -> None:
    """A geometry that cannot be shown is refused with its line."""
    with pytest.raises(UrdfError) as error:
        visuals(visual(text))
    assert sentence in str(error.value)
    assert error.value.line == 4


def test_broken_color() -> None:
    """A colour of three numbers is refused with its line and what is wanted."""
    with pytest.raises(UrdfError, match='four numbers from 0 to 1') as error:
        visuals('\n<visual><material name="m"><color rgba="1 0 0"/></material></visual>')
    assert error.value.line == 5


def test_visual_without_geometry() -> None:
    """A visual without geometry is refused."""
    with pytest.raises(UrdfError, match='There is no <geometry> in <visual> of link'):
        visuals('<visual/>')
