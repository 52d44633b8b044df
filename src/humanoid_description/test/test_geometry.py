# SPDX-License-Identifier: Apache-2.0
"""Check the geometry of standing and moving."""

from __future__ import annotations

from humanoid_description.geometry import convex_hull, margin_inside, outline
from humanoid_description.kinematics import joint_motion
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
