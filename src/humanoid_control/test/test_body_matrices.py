# SPDX-License-Identifier: Apache-2.0
"""Check the matrices of bodies against sums over their points of mass."""

from __future__ import annotations

from humanoid_control.dynamics import BodyModel
from humanoid_control.dynamics.body_matrices import axial, BodyMatrices
from humanoid_control.dynamics.rotations import from_rpy
import numpy as np
import pytest


@pytest.fixture(name='matrices', scope='module')
def _matrices(model: BodyModel) -> BodyMatrices:
    """Return the humanoid in a random motion."""
    generator = np.random.default_rng(8)
    positions, velocities = generator.normal(size=(2, len(model.joints)))
    rotation = from_rpy(0.3, -0.4, 2.0)
    return model.state(rotation, generator.normal(size=3), positions, velocities).matrices


def test_screws_leave_their_axis_in_place(matrices: BodyMatrices) -> None:
    """A joint moves no point of its axis, and turns about it at unit rate."""
    for screw, pose in zip(matrices.screws, matrices.poses[1:]):
        axis, origin = pose[:, 2], pose[:, 3]
        assert screw @ (origin + 0.7 * axis) == pytest.approx(np.zeros(4), abs=1e-12)
        assert axial(screw) / 2 == pytest.approx(axis[:3])


def test_twist_of_a_child(matrices: BodyMatrices) -> None:
    """A body moves as its parent does, and by its own joint."""
    tree = matrices.tree
    for joint, rate in enumerate(matrices.velocities_rad_s):
        parent = matrices.twists[tree.parents[joint + 1]]
        expected = parent + matrices.screws[joint] * rate
        assert matrices.twists[joint + 1] == pytest.approx(expected)


def test_root_carries_all(matrices: BodyMatrices) -> None:
    """Mass and forces at the root are those of all bodies together; a hand has only its own."""
    whole = matrices.inertias.sum(axis=0)
    assert matrices.composites[0] == pytest.approx(whole)
    assert whole[3, 3] == pytest.approx(matrices.tree.mass_kg)
    forces = matrices.accelerations @ matrices.inertias
    assert matrices.forces[0] == pytest.approx(forces.sum(axis=0))
    last = 1 + matrices.tree.joints.index('left_elbow')
    assert matrices.forces[last] == pytest.approx(forces[last])


def test_axial() -> None:
    """A force at a point has the torque of the cross product."""
    point, force = np.array([1.0, 2.0, 3.0]), np.array([-4.0, 5.0, 7.0])
    assert axial(np.outer(force, point)) == pytest.approx(np.cross(point, force))
