# SPDX-License-Identifier: Apache-2.0
"""Check what rays of the camera without OpenGL meet."""

from __future__ import annotations

from humanoid_simulation.camera.ray_cast import cast_rays, see_all
import mujoco
import numpy as np
import pytest

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
