# SPDX-License-Identifier: Apache-2.0
"""Build the MuJoCo model of a scene with robots in it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from humanoid_description.rotations import quaternion_from_rpy
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.model.description import (
    ALONE,
    check_placements,
    in_world,
    Physics,
    Placement,
    RobotDescription,
)
from humanoid_simulation.model.robot_spec import COLLISION_GROUP, MOST_ROBOTS, robot_spec, WORLD
from humanoid_simulation.scene.appearance import add_lighting, EDGE_PX, picture_of
from humanoid_simulation.scene.meshes import triangles_of
from humanoid_simulation.scene.parts import Finish, MESH, Part, Vector
from humanoid_simulation.scene.scene import FLOOR, Floor, Scene, Thing
import mujoco
import numpy as np

_GRIP_IMPRATIO = 50.0
"""
Ratio of frictional to normal impedance (`impratio`), if there are hands. Held objects creep out of
them at 0.4 mm/s with 10, at 0.1 with 50; 50 costs 4 % more than 10.
"""
_REST_M_S = 1e-3
"""Maximum velocity at which objects in contact with each other fall asleep."""
# Torsional and rolling friction of contacts; the sliding friction is set by the scene.
_TURNING_FRICTION_M, _ROLLING_FRICTION_M = 0.02, 0.001
# Time constant (s) and damping ratio: about as stiff as a rubber sole, without bouncing.
_SOLREF = (0.01, 1.0)
_GEOMS = {
    'box': mujoco.mjtGeom.mjGEOM_BOX,
    'sphere': mujoco.mjtGeom.mjGEOM_SPHERE,
    'cylinder': mujoco.mjtGeom.mjGEOM_CYLINDER,
    MESH: mujoco.mjtGeom.mjGEOM_MESH,
}
DECORATION_GROUP = 1
"""The geom group of visual geoms, which do not collide."""


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
        raise SimulationError(
            f'A world holds at most {MOST_ROBOTS} robots, not {len(placements)}.'
        )
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
        raise SimulationError(f'MuJoCo cannot build the world: {error}.') from error


def _check_names(scene: Scene, placements: Sequence[Placement]) -> None:
    """Check that no object has the name of a robot."""
    robots = {placement.robot or ALONE for placement in placements}
    for thing in scene.things:
        if thing.name in robots:
            raise SimulationError(
                f"Scene '{scene.name}' has an object named '{thing.name}', which is also the name "
                'of a robot. Rename one of them.'
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


def add_scene(world: Any, scene: Scene) -> None:
    """
    Add the floor, the objects and the lights of a scene to a model specification.

    Parameters
    ----------
    world
        The `mujoco.MjSpec` to add to.
    scene
        The scene; it is lit as indoors if it has rooms.

    """
    _add_floor(world, scene.floor)
    for thing in scene.things:
        _add_thing(world, thing)
    add_lighting(world, bool(scene.rooms))


def _add_floor(world: Any, floor: Floor) -> None:
    """Add an infinite ground plane with a checker texture."""
    texture = world.add_texture(
        name=FLOOR,
        type=mujoco.mjtTexture.mjTEXTURE_2D,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_CHECKER,
        rgb1=floor.colours_rgb[0],
        rgb2=floor.colours_rgb[1],
        width=256,
        height=256,
    )
    repeat = 0.5 / floor.tile_m
    material = world.add_material(name=FLOOR, texrepeat=(repeat, repeat), texuniform=True)
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = texture.name
    geom = world.worldbody.add_body(name=FLOOR).add_geom(
        name=FLOOR,
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        size=(0.0, 0.0, 0.1),
        material=material.name,
    )
    _set_contact(geom, floor.friction)


def _add_thing(world: Any, thing: Thing) -> None:
    """Add the body of an object, with a free joint unless it is fixed."""
    body = world.worldbody.add_body(
        name=thing.name, pos=thing.position_m, quat=quaternion_from_rpy(*thing.orientation_rpy_rad)
    )
    if not thing.is_fixed:
        body.add_freejoint(name=thing.name)
    mass_kg = thing.mass_kg
    for number, part in enumerate(thing.parts):
        name = f'{thing.name}/{number}' if number else thing.name
        geom = _add_part(world, body, name, part)
        if part.collides:
            # The first colliding part has all of the mass.
            geom.mass, mass_kg = mass_kg, 0.0
            _set_contact(geom, thing.friction)
            if part.shape == 'sphere' and part.is_shown and thing.kind:
                geom.condim = 6  # enables rolling friction, without which balls roll for ever
        else:
            geom.mass = 0.0


def _add_part(world: Any, body: Any, name: str, part: Part) -> Any:
    """Add the geom of a part, with collisions disabled and its mass not set yet."""
    geom = body.add_geom(
        name=name,
        type=_GEOMS[part.shape],
        pos=part.position_m,
        quat=quaternion_from_rpy(*part.orientation_rpy_rad),
        rgba=part.colour_rgba,
        contype=0,
        conaffinity=0,
    )
    if part.shape == MESH:
        geom.meshname = _mesh(world, part)
    else:
        geom.size = _half_sizes(part)
    if not part.is_shown:
        geom.group = COLLISION_GROUP
    elif not part.collides:
        geom.group = DECORATION_GROUP
    if part.shine > 0.0:
        geom.material = _shining(world, part.shine)
    elif part.finish is not None and part.finish.pattern != 'plain':
        geom.material = _painted(world, part.finish)
        geom.rgba = (1.0, 1.0, 1.0, 1.0)
    return geom


def _mesh(world: Any, part: Part) -> str:
    """Return the name of the mesh of a part; add it if it does not exist yet."""
    name = f'{part.mesh} {" ".join(f"{edge:g}" for edge in part.size_m)}'
    if world.mesh(name) is None:
        corners = triangles_of(part.mesh).reshape(-1, 3).astype(np.float64)
        points, faces = np.unique(corners, axis=0, return_inverse=True)
        mesh = world.add_mesh(name=name, uservert=(points * part.size_m).ravel())
        mesh.userface = faces.astype(np.int32).ravel()
        mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
    return name


def _shining(world: Any, shine: float) -> str:
    """Return the name of an emissive material; add it if it does not exist yet."""
    name = f'shining {shine:g}'
    if world.material(name) is None:
        world.add_material(name=name, emission=shine)
    return name


def _painted(world: Any, finish: Finish) -> str:
    """Return the name of the textured material of a finish; add it if it does not exist yet."""
    name = f'{finish}'
    if world.material(name) is None:
        texture = world.add_texture(
            name=name,
            type=mujoco.mjtTexture.mjTEXTURE_2D,
            width=EDGE_PX,
            height=EDGE_PX,
            nchannel=3,
        )
        texture.data = picture_of(finish).tobytes()
        repeat = 1.0 / finish.tile_m
        material = world.add_material(
            name=name, texrepeat=(repeat, repeat), texuniform=True, specular=0.1
        )
        material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = name
    return name


def _half_sizes(part: Part) -> Vector:
    """Convert a size to MuJoCo's convention: half edges and half heights, but full radii."""
    if part.shape == 'box':
        return tuple(edge / 2 for edge in part.size_m)
    if part.shape == 'cylinder':
        radius, height = part.size_m
        return (radius, height / 2, 0.0)
    return (part.size_m[0], 0.0, 0.0)


def _set_contact(geom: Any, friction: float) -> None:
    """Set contact parameters that, by their priority, override those of other geoms."""
    geom.contype, geom.conaffinity = WORLD, WORLD
    geom.friction = (friction, _TURNING_FRICTION_M, _ROLLING_FRICTION_M)
    geom.condim, geom.priority = 4, 1
    geom.solref = _SOLREF
