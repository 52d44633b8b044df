# SPDX-License-Identifier: Apache-2.0
"""Indices of a robot in the arrays of a MuJoCo model."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from humanoid_control.backends import Array
from humanoid_simulation.backend.state import Floating, floating_body
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.model.description import (
    ACCELEROMETER,
    FLOATING_BASE,
    in_world,
    RobotDescription,
)
import mujoco
import numpy as np
from numpy.typing import NDArray

Indices = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Layout:
    """Indices of the base, of n joints and of the sensors in MuJoCo's arrays."""

    floating: Floating
    positions: Indices
    velocities: Indices
    servos: Indices
    followers: Indices
    """Indices in `qpos` of the mimic joints."""
    followed: Indices
    """Indices in `qpos` of the joints that they mimic."""
    follower_velocities: Indices
    acceleration: slice
    base: int
    feet: tuple[int, int]
    soles: tuple[int, int]
    imu_mount: Array
    """Orientation of the inertial measurement unit in the base frame, a quaternion (4,)."""


def layout_of(model: Any, description: RobotDescription, robot: str) -> Layout:
    """
    Find the indices of a robot in the arrays of a MuJoCo model.

    Parameters
    ----------
    model
        The compiled world.
    description
        Description of the robot.
    robot
        Its name; '' if it has none.

    Raises
    ------
    SimulationError
        The inertial measurement unit is not fixed to the base.

    """

    def body(name: str) -> int:
        return int(model.body(in_world(robot, name)).id)

    names = [in_world(robot, name) for name in description.drives]
    sensor = int(model.sensor(in_world(robot, ACCELEROMETER)).adr[0])
    left, right = description.feet
    left_sole, right_sole = description.soles
    base = body(description.base)
    return Layout(
        floating_body(model, in_world(robot, FLOATING_BASE)),
        np.array([model.joint(name).qposadr[0] for name in names], dtype=np.intp),
        np.array([model.joint(name).dofadr[0] for name in names], dtype=np.intp),
        np.array([model.actuator(name).id for name in names], dtype=np.intp),
        *_mimicking(model, description, robot),
        slice(sensor, sensor + 3),
        base,
        (body(left), body(right)),
        (body(left_sole), body(right_sole)),
        _mount(model, body(description.imu), base),
    )


def _mimicking(
    model: Any, description: RobotDescription, robot: str
) -> tuple[Indices, Indices, Indices]:
    """Find the indices of thumbs and of their fingers in `qpos`, and of thumbs in `qvel`."""
    hands = [in_world(robot, f'{description.prefix}{side}') for side in description.hands]
    thumbs, fingers = (
        [model.joint(hand + name) for hand in hands] for name in ('_gripper_thumb', '_gripper')
    )
    return (
        np.array([thumb.qposadr[0] for thumb in thumbs], dtype=np.intp),
        np.array([finger.qposadr[0] for finger in fingers], dtype=np.intp),
        np.array([thumb.dofadr[0] for thumb in thumbs], dtype=np.intp),
    )


def _mount(model: Any, body: int, base: int) -> Array:
    """Compute the orientation in the base frame of a body that is fixed to the base."""
    mount = np.array([1.0, 0.0, 0.0, 0.0])
    while body != base:
        if body == 0 or model.body_jntnum[body]:
            raise SimulationError(
                f"The IMU must be fixed to the base, but '{model.body(body).name}' lies between "
                'them.'
            )
        outer = mount.copy()
        mujoco.mju_mulQuat(mount, model.body_quat[body], outer)
        body = int(model.body_parentid[body])
    return mount
