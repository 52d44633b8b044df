# SPDX-License-Identifier: Apache-2.0
"""Check the colours that rays show."""

from __future__ import annotations

from humanoid_simulation.camera.flat_colors import brightness, geom_colors, sky_color
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
