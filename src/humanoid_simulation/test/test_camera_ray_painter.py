# SPDX-License-Identifier: Apache-2.0
"""Check what rays of the camera without OpenGL meet, and the colours that they show."""

from __future__ import annotations

from humanoid_simulation.camera.images import see_all
from humanoid_simulation.camera.ray_painter import brightness, cast_rays, geom_colors, sky_color
import mujoco
import numpy as np
import pytest

MODEL = """
<mujoco>
  <asset>
    <texture name="tiles" type="2d" builtin="checker" rgb1="1 0 0" rgb2="0 0 1" width="64"
      height="64"/>
    <texture name="sky" type="skybox" builtin="flat" rgb1="0.2 0.4 0.6" rgb2="0.2 0.4 0.6"
      width="8" height="48"/>
    <material name="tiles" texture="tiles"/>
    <material name="paint" rgba="0 1 0 1"/>
  </asset>
  <visual><headlight ambient="0.1 0.1 0.1" diffuse="0 0 0"/></visual>
  <worldbody>
    <light type="directional" dir="0 0 -1" ambient="0 0 0" diffuse="0.5 0.5 0.5"/>
    <geom type="plane" size="1 1 1" material="tiles"/>
    <geom type="sphere" size="0.1" material="paint"/>
    <geom type="sphere" size="0.1" rgba="0.9 0.8 0.7 1"/>
    <geom type="sphere" size="0.1" material="paint" rgba="0.9 0.8 0.7 1"/>
  </worldbody>
</mujoco>
"""
# A lamp on a post: the post collides, the lamp is only to be seen, and a ball is behind it.
LAMP = """
<mujoco>
  <worldbody>
    <body name="lamp" pos="2 0 0">
      <geom type="box" size="0.05 0.05 0.5" pos="0 0 -0.5"/>
      <geom type="sphere" size="0.2" pos="0 0.5 0.5" contype="0" conaffinity="0"/>
    </body>
    <body pos="4 1 1"><geom type="sphere" size="0.1"/></body>
  </worldbody>
</mujoco>
"""


@pytest.fixture(name='model', scope='module')
def _model() -> mujoco.MjModel:
    """Return a model with a colour of every origin."""
    return mujoco.MjModel.from_xml_string(MODEL)


def test_colors(model: mujoco.MjModel) -> None:
    """A geom has its own colour, else that of its material, and the mean of its texture."""
    expected = [[0.5, 0.0, 0.5], [0.0, 1.0, 0.0], [0.9, 0.8, 0.7], [0.9, 0.8, 0.7]]
    assert geom_colors(model) == pytest.approx(np.array(expected), abs=0.01)


def test_sky(model: mujoco.MjModel) -> None:
    """The sky has the mean colour of its texture."""
    assert sky_color(model) == pytest.approx([0.2, 0.4, 0.6], abs=0.01)


def test_brightness(model: mujoco.MjModel) -> None:
    """What faces the light is bright, what is at an angle less so, by the cosine."""
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    normals = np.array([[0.0, 0.0, 1.0], [0.0, 0.6, 0.8], [0.0, 0.0, -1.0]])
    light = brightness(model, data, np.zeros((3, 3)), normals, np.array([1.0, 0.0, 0.0]))
    assert light[:, 0] == pytest.approx([0.6, 0.5, 0.1])


def lamp() -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return the lamp."""
    model = mujoco.MjModel.from_xml_string(LAMP)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def test_what_is_only_to_be_seen_is_met() -> None:
    """A ray meets a geom that does not collide, beside those of its body that do."""
    model, data = lamp()
    see_all(model)
    ray = np.array([[2.0, 0.5, 0.5]]) / np.linalg.norm([2.0, 0.5, 0.5])
    hits = cast_rays(model, data, np.zeros(3), ray)
    assert hits.geoms.tolist() == [1]
    assert hits.distances_m[0] == pytest.approx(np.linalg.norm([2.0, 0.5, 0.5]) - 0.2)


def test_rays_that_meet_nothing_of_what_is_beside_them() -> None:
    """What is beside the cone of the rays is left out, and shown again afterwards."""
    model, data = lamp()
    see_all(model)
    groups = model.geom_group.copy()
    rays = np.array([[0.0, 1.0, 0.0], [0.1, 1.0, 0.0], [4.0, 1.0, 1.0]])
    rays /= np.linalg.norm(rays, axis=1, keepdims=True)
    assert cast_rays(model, data, np.zeros(3), rays[:2]).geoms.tolist() == [-1, -1]
    assert cast_rays(model, data, np.zeros(3), rays).geoms.tolist()[:2] == [-1, -1]
    assert np.array_equal(model.geom_group, groups)
    backwards = np.vstack([rays, -rays])
    assert cast_rays(model, data, np.zeros(3), backwards).geoms.tolist()[3:] == [-1, -1, -1]
