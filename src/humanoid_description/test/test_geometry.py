# SPDX-License-Identifier: Apache-2.0
"""Check the geometry of standing and moving."""

from __future__ import annotations

from humanoid_description.geometry import convex_hull, margin_inside, outline
from humanoid_description.kinematics import joint_motion, pose_along, poses
from humanoid_description.loading import load_robot
from humanoid_description.robot import Joint, Shape
import numpy as np
import pytest

SQUARE = np.array([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (1.0, 1.0), (1.0, 0.0)])


def test_convex_hull() -> None:
    """The hull has the outer corners only, anticlockwise."""
    assert convex_hull(SQUARE).tolist() == [[0, 0], [2, 0], [2, 2], [0, 2]]


@pytest.mark.parametrize(
    ('point', 'margin'), [((1.0, 1.0), 1.0), ((0.25, 1.0), 0.25), ((1.0, -0.5), -0.5)]
)
def test_margin(point: tuple[float, float], margin: float) -> None:
    """The margin is the distance to the nearest edge, and negative outside."""
    assert margin_inside(np.array(point), SQUARE) == pytest.approx(margin)


@pytest.mark.parametrize(
    ('kind', 'size', 'half'),
    [
        ('box', (2.0, 4.0, 6.0), (1.0, 2.0, 3.0)),
        ('cylinder', (2.0, 6.0), (2.0, 2.0, 3.0)),
        ('sphere', (2.0,), (2.0, 2.0, 2.0)),
    ],
)
def test_outline(kind: str, size: tuple[float, ...], half: tuple[float, ...]) -> None:
    """A shape extends equally to both sides of its place."""
    pose = np.eye(4)
    pose[:3, 3] = (10.0, 20.0, 30.0)
    corners = outline([Shape(kind, size, np.eye(4))], pose) - pose[:3, 3]
    assert corners.max(axis=0) == pytest.approx(half)
    assert corners.min(axis=0) == pytest.approx([-h for h in half])


def test_a_mesh_has_no_outline() -> None:
    """A mesh, which is not read, has no corners."""
    assert outline([Shape('mesh', (), np.eye(4))], np.eye(4)).shape == (0, 3)


def moved(kind: str, position: float) -> np.ndarray:  # type: ignore[type-arg]
    """Return where the motion of a joint about twice z takes the point (1, 0, 0)."""
    joint = Joint('j', kind, 'a', 'b', np.eye(4), np.array([0.0, 0.0, 2.0]))
    return (joint_motion(joint, position) @ (1.0, 0.0, 0.0, 1.0))[:3]


def test_motion() -> None:
    """A revolute joint turns right-handed, a prismatic one shifts; the axis' length is nothing."""
    assert moved('revolute', np.pi / 2) == pytest.approx([0, 1, 0])
    assert moved('prismatic', 0.5) == pytest.approx([1, 0, 0.5])


SLIDES = """<robot name="r"><link name="base"/><link name="a"/><link name="b"/><link name="c"/>
<joint name="first" type="prismatic"><parent link="base"/><child link="a"/>
<axis xyz="1 0 0"/><limit lower="0" upper="9" velocity="1" effort="1"/></joint>
<joint name="second" type="prismatic"><parent link="{second}"/><child link="b"/>
<axis xyz="0 1 0"/><limit lower="0" upper="9" velocity="1" effort="1"/>
<mimic joint="first" multiplier="2" offset="0.5"/></joint>
<joint name="third" type="prismatic"><parent link="{third}"/><child link="c"/>
<axis xyz="0 0 1"/><limit lower="0" upper="9" velocity="1" effort="1"/>
<mimic joint="second" multiplier="3" offset="1"/></joint></robot>"""


def test_joint_that_mimics_a_joint_that_mimics_another() -> None:
    """It follows both, in the same chain or beside it; a position that is given counts first."""
    row = load_robot(SLIDES.format(second='a', third='b'), 'row.urdf')
    assert poses(row, {'first': 1.0})['c'][:3, 3] == pytest.approx([1.0, 2.5, 8.5])
    assert pose_along(list(row.joints), {'first': 1.0})[:3, 3] == pytest.approx([1.0, 2.5, 8.5])
    fan = load_robot(SLIDES.format(second='base', third='base'), 'fan.urdf')
    assert poses(fan, {'first': 1.0})['c'][:3, 3] == pytest.approx([0.0, 0.0, 8.5])
    assert poses(fan)['c'][:3, 3] == pytest.approx([0.0, 0.0, 2.5])
    assert poses(fan, {'first': 1.0, 'second': 2.0})['c'][2, 3] == pytest.approx(7.0)
