# SPDX-License-Identifier: Apache-2.0
"""Build the MuJoCo model of a scene with robots in it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from humanoid_simulation.collisions import MOST_ROBOTS
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.model.description import RobotDescription
from humanoid_simulation.model.physics import Physics
from humanoid_simulation.model.placement import check_placements, Placement
from humanoid_simulation.model.robot_spec import robot_spec
from humanoid_simulation.scene import Scene
from humanoid_simulation.scene.building import add_scene
import mujoco

ALONE = 'robot'
"""Name of an unnamed robot among the entities of the world."""

_GRIP_IMPRATIO = 50.0
"""
Ratio of frictional to normal impedance (`impratio`), if there are hands. Held objects creep out of
them at 0.4 mm/s with 10, at 0.1 with 50; 50 costs 4 % more than 10.
"""
_REST_M_S = 1e-3
"""Maximum velocity at which objects in contact with each other fall asleep."""


def in_world(robot: str, name: str) -> str:
    """
    Compute the name of a link, joint, sensor or camera of a robot in the MuJoCo model.

    Parameters
    ----------
    robot
        Name of the robot; '' if it has none.
    name
        Name of this element in the description, with the robot's prefix.

    """
    return f'{robot or ALONE}/{name}'


def build_world(
    description: RobotDescription,
    scene: Scene,
    placements: Sequence[Placement],
    physics: Physics,
) -> Any:
    """
    Compile the MuJoCo model of a scene with robots of one kind in it.

    Parameters
    ----------
    description
        Description shared by the robots.
    scene
        Floor and objects.
    placements
        The name of each robot, and the place on the ground at which it is attached.
    physics
        Time step, self-collisions, and factors of masses.

    Returns
    -------
    mujoco.MjModel
        The compiled model.

    Raises
    ------
    SimulationError
        Names clash, there are too many robots, or MuJoCo cannot compile the world.

    """
    check_placements(placements)
    _check_names(scene, placements)
    if len(placements) > MOST_ROBOTS:
        raise SimulationError(f'A world has room for {MOST_ROBOTS} robots, not {len(placements)}.')
    world = _empty_world(physics)
    if description.hands:
        world.option.impratio = _GRIP_IMPRATIO
    add_scene(world, scene)
    if scene.objects and physics.sleep:
        world.option.enableflags |= int(mujoco.mjtEnableBit.mjENBL_SLEEP)
        world.option.sleep_tolerance = _REST_M_S
    robots = [robot_spec(description, number, physics) for number, _ in enumerate(placements)]
    for placement, robot in zip(placements, robots):
        frame = world.worldbody.add_frame(pos=(placement.x_m, placement.y_m, placement.z_m))
        world.attach(robot, prefix=in_world(placement.robot, ''), frame=frame)
    try:
        return world.compile()
    except ValueError as error:
        raise SimulationError(f'MuJoCo cannot make a world of this: {error}.') from error


def _check_names(scene: Scene, placements: Sequence[Placement]) -> None:
    """Check that no object has the name of a robot."""
    robots = {placement.robot or ALONE for placement in placements}
    for thing in scene.things:
        if thing.name in robots:
            raise SimulationError(
                f"Scene '{scene.name}' has a thing called '{thing.name}', as a robot is. Give the "
                'thing or the robot another name.'
            )


def _empty_world(physics: Physics) -> Any:
    """Create an empty world with the options of the physics."""
    world = mujoco.MjSpec()
    world.modelname = 'world'
    option = world.option
    option.timestep = physics.period_s
    option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    option.impratio = 10.0
    # Divergence must be detected, not hidden by an automatic reset.
    option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
    return world
