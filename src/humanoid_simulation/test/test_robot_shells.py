# SPDX-License-Identifier: Apache-2.0
"""The shells of the robot are seen by simulated cameras, and do nothing else."""

from __future__ import annotations

from xml.etree import ElementTree

from humanoid_description.expansion import humanoid_urdf
from humanoid_simulation.camera.images import HIDDEN_GROUP
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.model.robot_spec import spec_of
import mujoco
import numpy as np
import pytest


def test_shells_are_seen_and_weigh_nothing() -> None:
    """Cameras see the mesh of each link; nothing collides with it, and no mass changes."""
    urdf = humanoid_urdf(scale=0.65, hands=True)
    robot = ElementTree.fromstring(urdf)
    for link in robot.findall('link'):
        for visual in link.findall('visual'):
            link.remove(visual)
    bare = spec_of(ElementTree.tostring(robot, encoding='unicode')).compile()
    model = spec_of(urdf).compile()
    is_mesh = model.geom_type == mujoco.mjtGeom.mjGEOM_MESH
    names = {model.body(body).name for body in model.geom_bodyid[is_mesh]}
    assert {'torso', 'head', 'left_forearm', 'right_finger', 'left_foot'} <= names
    assert (model.geom_group[is_mesh] < HIDDEN_GROUP).all()
    assert not model.geom_contype[is_mesh].any()
    assert not model.geom_conaffinity[is_mesh].any()
    for quantity in ('body_mass', 'body_inertia', 'body_ipos', 'body_iquat', 'dof_damping'):
        assert np.array_equal(getattr(model, quantity), getattr(bare, quantity)), quantity


def test_mesh_has_the_size_of_the_robot() -> None:
    """The head of a robot of scale 0.5 is half as high."""
    heights_m = []
    for scale in (1.0, 0.5):
        model = spec_of(humanoid_urdf(scale=scale)).compile()
        heights_m.append(np.ptp(_vertices(model, 'head_head')[:, 2]))
    assert heights_m[0] == pytest.approx(0.138, abs=1e-3)
    assert heights_m[1] == pytest.approx(heights_m[0] / 2, rel=1e-3)


def _vertices(model: mujoco.MjModel, geom: str) -> np.ndarray:
    """Return the vertices of a mesh in the frame of its link."""
    number = model.geom(geom).id
    mesh = model.geom_dataid[number]
    first = model.mesh_vertadr[mesh]
    last = first + model.mesh_vertnum[mesh]
    vertices = model.mesh_vert[first:last]
    turn = np.empty(9)
    mujoco.mju_quat2Mat(turn, model.geom_quat[number])
    return vertices @ turn.reshape(3, 3).T + model.geom_pos[number]


def test_mesh_of_an_unknown_package() -> None:
    """A mesh in a package that is not there is refused, with what to do."""
    urdf = humanoid_urdf().replace('package://humanoid_description/', 'package://humanoid_x/', 1)
    with pytest.raises(
        SimulationError, match=r"the mesh 'package://humanoid_x/.*was not found: there is no"
    ):
        spec_of(urdf)


def test_mesh_that_is_missing() -> None:
    """A mesh file that is not there is refused by its name."""
    urdf = humanoid_urdf().replace('/chest.stl', '/chess.stl')
    with pytest.raises((SimulationError, ValueError), match='chess.stl'):
        spec_of(urdf).compile()
