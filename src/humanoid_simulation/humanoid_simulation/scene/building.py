# SPDX-License-Identifier: Apache-2.0
"""Add a scene to the specification of a world."""

from __future__ import annotations

from typing import Any

from humanoid_simulation.collisions import WORLD
from humanoid_simulation.rotations import from_rpy
from humanoid_simulation.scene.lighting import add_lighting
from humanoid_simulation.scene.scene import FLOOR, Floor, Scene, Thing, Vector
import mujoco

# Of contacts that turn on the spot, and roll; the sliding one is the scene's.
_TURNING_FRICTION_M, _ROLLING_FRICTION_M = 0.02, 0.001
# A contact is about as stiff as a rubber sole: it settles in so many seconds, without bouncing.
_SOLREF = (0.01, 1.0)
_GEOMS = {
    'box': mujoco.mjtGeom.mjGEOM_BOX,
    'sphere': mujoco.mjtGeom.mjGEOM_SPHERE,
    'cylinder': mujoco.mjtGeom.mjGEOM_CYLINDER,
}


def add_scene(world: Any, scene: Scene) -> None:
    """Add the floor, its things and some light."""
    _add_floor(world, scene.floor)
    for thing in scene.things:
        _add_thing(world, thing)
    add_lighting(world)


def _add_floor(world: Any, floor: Floor) -> None:
    """Add an endless floor of tiles."""
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
    """Add a thing, which moves freely if it weighs something."""
    body = world.worldbody.add_body(
        name=thing.name, pos=thing.position_m, quat=from_rpy(*thing.orientation_rpy_rad)
    )
    if not thing.is_fixed:
        body.add_freejoint(name=thing.name)
    geom = body.add_geom(
        name=thing.name,
        type=_GEOMS[thing.shape],
        size=_half_sizes(thing),
        rgba=thing.colour_rgba,
        mass=thing.mass_kg,
    )
    _set_contact(geom, thing.friction)


def _half_sizes(thing: Thing) -> Vector:
    """Return the size as MuJoCo wants it: halves of edges, but radii."""
    if thing.shape == 'box':
        return tuple(edge / 2 for edge in thing.size_m)
    if thing.shape == 'cylinder':
        radius, height = thing.size_m
        return (radius, height / 2, 0.0)
    return (thing.size_m[0], 0.0, 0.0)


def _set_contact(geom: Any, friction: float) -> None:
    """Let the world decide how contacts with it behave: its geoms have the priority."""
    geom.contype, geom.conaffinity = WORLD, WORLD
    geom.friction = (friction, _TURNING_FRICTION_M, _ROLLING_FRICTION_M)
    geom.condim, geom.priority = 4, 1
    geom.solref = _SOLREF
