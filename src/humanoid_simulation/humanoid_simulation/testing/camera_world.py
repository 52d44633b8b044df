# SPDX-License-Identifier: Apache-2.0
"""A world with predictable camera images, for the tests of the cameras."""

from __future__ import annotations

import mujoco

# The camera is at (0, 0, 1) and looks along x, as the head of a robot does. The quaternions are
# that of the optical frame in the link, and that of MuJoCo's camera in the optical frame.
# On the wall, 2 m ahead, hang a red box to the left and a blue one below. A green ball is 1.5 m
# ahead on the right. The white case around the camera and the pink collision geom are invisible.
WORLD = """
<mujoco>
  <statistic extent="3" center="0 0 1"/>
  <visual>
    <headlight ambient="0.4 0.4 0.4" diffuse="0.6 0.6 0.6" specular="0 0 0"/>
  </visual>
  <asset>
    <texture type="skybox" builtin="flat" rgb1="0.2 0.4 0.6" rgb2="0.2 0.4 0.6" width="8"
      height="48"/>
  </asset>
  <default><geom contype="0" conaffinity="0"/></default>
  <worldbody>
    <geom name="wall" type="box" size="0.1 5 5" pos="2.1 0 1" rgba="0.5 0.51 0.5 1"/>
    <geom name="left" type="box" size="0.1 0.2 0.2" pos="2.0 0.5 1" rgba="1 0 0 1"/>
    <geom name="below" type="box" size="0.1 0.2 0.1" pos="2.0 0 0.4" rgba="0 0 1 1"/>
    <body name="ball" pos="1.5 -0.5 1.2">
      <freejoint/>
      <geom type="sphere" size="0.1" mass="1" rgba="0 1 0 1"/>
    </body>
    <geom type="sphere" size="0.3" pos="1 0 1" rgba="1 0 1 1" group="3"/>
    <body name="head" pos="0 0 1">
      <geom type="sphere" size="0.1" rgba="1 1 1 1"/>
      <body name="camera_optical_frame" quat="0.5 -0.5 0.5 -0.5">
        <camera name="eye" fovy="60" quat="0 1 0 0"/>
      </body>
    </body>
    <body name="other" pos="0 3 1" quat="0 0 0 1">
      <body quat="0.5 -0.5 0.5 -0.5">
        <camera name="back_eye" fovy="60" quat="0 1 0 0"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""


def world() -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return the model of the world, and its data in the initial state."""
    model = mujoco.MjModel.from_xml_string(WORLD)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data
