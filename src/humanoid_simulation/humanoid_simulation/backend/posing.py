# SPDX-License-Identifier: Apache-2.0
"""Put a robot into a posture, with its lowest point on the ground."""

from __future__ import annotations

from typing import Any

from humanoid_control.backends import Array
from humanoid_simulation.backend.layout import Layout
from humanoid_simulation.collisions import COLLISION_GROUP
from humanoid_simulation.keyframes import Keyframe
from humanoid_simulation.model import Placement
from humanoid_simulation.rotations import from_rpy
import mujoco
import numpy as np

# Initial penetration of a standing robot into the ground, so that its soles bear load at once.
_SINK_M = 1e-4


def pose(
    model: Any,
    data: Any,
    layout: Layout,
    place: Placement,
    keyframe: Keyframe,
    positions_rad: Array,
) -> None:
    """
    Set the base and the joints of a robot, with its lowest point on the ground.

    Of the state, only `qpos` is valid afterwards; derived quantities are not recomputed.

    Parameters
    ----------
    model, data
        The MuJoCo model, and the state that is set.
    layout
        Indices of the robot in them.
    place
        Its initial position on the ground, and its heading.
    keyframe
        Roll and pitch of the base; its joints are not used.
    positions_rad
        Positions of the driven joints (n,); mimic joints follow.

    """
    data.qpos[layout.positions] = positions_rad
    data.qpos[layout.followers] = data.qpos[layout.followed]
    data.qpos[layout.floating.orientation] = from_rpy(
        keyframe.roll_rad, keyframe.pitch_rad, place.yaw_rad
    )
    data.qpos[layout.floating.position] = (place.x_m, place.y_m, 0.0)
    mujoco.mj_kinematics(model, data)
    height_m = place.z_m - _SINK_M - _lowest_m(model, data, layout.base)
    data.qpos[layout.floating.position] = (place.x_m, place.y_m, height_m)


def _lowest_m(model: Any, data: Any, base: int) -> float:
    """Compute the height of the lowest point of a robot."""
    root = model.body_rootid[base]
    return min(
        _lowest_of_geom(model, data, geom)
        for geom in range(model.ngeom)
        if model.geom_group[geom] == COLLISION_GROUP
        and model.body_rootid[model.geom_bodyid[geom]] == root
    )


def _lowest_of_geom(model: Any, data: Any, geom: int) -> float:
    """Compute the height of the lowest point of a geom; for a mesh, of its bounding box."""
    up: Array = data.geom_xmat[geom].reshape(3, 3)[2]
    size = model.geom_size[geom]
    height = float(data.geom_xpos[geom][2])
    kind = model.geom_type[geom]
    if kind == mujoco.mjtGeom.mjGEOM_SPHERE:
        return height - float(size[0])
    if kind == mujoco.mjtGeom.mjGEOM_CYLINDER:
        slant = float(np.hypot(up[0], up[1]))
        return height - float(size[0]) * slant - float(size[1]) * abs(float(up[2]))
    centre, half = model.geom_aabb[geom][:3], model.geom_aabb[geom][3:]
    return height + float(up @ centre) - float(np.abs(up) @ half)
