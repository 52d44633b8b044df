# SPDX-License-Identifier: Apache-2.0
"""
Build the MuJoCo specification of a robot from its URDF and its drives, with its collision bits.

Two geoms collide when a bit of the `contype` of one is set in the `conaffinity` of the other.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from humanoid_description.drives import Drive
from humanoid_description.errors import DescriptionError
from humanoid_description.mesh_files import is_remote, mesh_path
from humanoid_simulation.errors import named, SimulationError
from humanoid_simulation.model.description import (
    ACCELEROMETER,
    CAMERA,
    FLOATING_BASE,
    Physics,
    RobotDescription,
)
import mujoco

FIELD_OF_VIEW_DEG = 60.0

_GEAR = (0.004, 1.0)
"""Time constant (s) and damping of the constraint between finger and thumb."""
_PAD_FRICTION = (1.2, 0.02, 0.001)
"""Friction of rubber pads: sliding, and, in m, torsional and rolling."""
_PAD_STIFFNESS, _PAD_DAMPING = 0.25, 1.3
"""
Stiffness and damping of contacts with pads, in units of the physics period T: 1 / T^2 and 1 / T.

MuJoCo's contacts leave out the centripetal acceleration of a hand, so that what it holds drifts to
its fingertips while the robot walks: by 0.36 mm/s with the usual contacts, by 0.05 mm/s with a
damping of 1, which takes all of a slip away in one period, and by 0.02 mm/s with 1.3. At 2 it
oscillates, and drifts across the hand. The benchmark `hand_drift.py` measures that.
"""

# ROS: z forward and y down; MuJoCo: z backward and y up.
_FROM_OPTICAL_FRAME = (0.0, 1.0, 0.0, 0.0)
# What MuJoCo discards by default when it reads a URDF: visuals, and links that are fixed to
# others, such as the frames of sensors. Otherwise it would also drop the folders of meshes.
_KEEP = {'discardvisual': 'false', 'fusestatic': 'false', 'strippath': 'false'}

WORLD = 1
_ARM_ON_ARM = 1 << 1
_ARM_ON_TRUNK = 1 << 2
_LEG_ON_LEG = 1 << 3
_FIRST_ROBOT = 8
MOST_ROBOTS = 20
_ALL_ROBOTS = ((1 << MOST_ROBOTS) - 1) << _FIRST_ROBOT

_ARMS = ('upper_arm', 'forearm', 'palm', 'finger', 'thumb')
_TRUNK = ('base_link', 'torso', 'head', 'left_thigh', 'right_thigh')
_LEGS = ('thigh', 'shank', 'foot')

COLLISION_GROUP = 3
"""The group of the geoms that collide but are not rendered."""


def robot_spec(description: RobotDescription, number: int, physics: Physics) -> Any:
    """
    Build the MuJoCo specification of a robot, with a floating base and position servos.

    Parameters
    ----------
    description
        URDF and drives of the robot.
    number
        Index of the robot in its world, from 0 on, for its collision bits.
    physics
        Which links collide with each other, and the factors of their masses.

    Returns
    -------
    mujoco.MjSpec
        Names are those of the URDF, with the robot's prefix but without its name.

    Raises
    ------
    SimulationError
        The URDF cannot be read, lacks a link or a joint that is needed, or a link whose mass is
        to be scaled has none.

    """
    spec = spec_of(description.urdf)
    _body(spec, description.base).add_freejoint(name=FLOATING_BASE)
    for name, drive in description.drives.items():
        _add_drive(spec, name, drive)
    for side in description.hands:
        _add_hand(spec, description.prefix + side, physics.period_s)
    _set_collisions(spec, description.prefix, number, physics.self_collision)
    _add_accelerometer(spec, description.imu)
    _body(spec, description.camera).add_camera(
        name=CAMERA, fovy=FIELD_OF_VIEW_DEG, quat=_FROM_OPTICAL_FRAME
    )
    _change_masses(spec, physics)
    return spec


def _body(spec: Any, name: str) -> Any:
    """Find a link by name; the error names a link that is missing."""
    return named('link', name, {body.name: body for body in spec.bodies})


def _add_drive(spec: Any, name: str, drive: Drive) -> None:
    """
    Add the rotor and the servo of a joint.

    The range of its input is unlimited: feed-forward may exceed the range of the joint.
    """
    joint = named('joint', name, {joint.name: joint for joint in spec.joints})
    joint.armature = drive.armature
    servo = spec.add_actuator(name=name, target=name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    servo.set_to_position(kp=drive.kp, kv=drive.kd)
    servo.forcelimited = True
    servo.forcerange = (-drive.effort, drive.effort)


def _add_hand(spec: Any, side: str, period_s: float) -> None:
    """
    Couple the thumb to the finger, as a gear between them does, and give both soft pads.

    Forearm and palm meet at the wrist, and finger and thumb where the hand closes: collisions
    within these pairs are excluded.
    """
    finger, thumb = (_body(spec, f'{side}_{part}') for part in ('finger', 'thumb'))
    follower = named('joint', f'{side}_gripper_thumb', {each.name: each for each in spec.joints})
    gear = spec.add_equality(
        name=follower.name,
        type=mujoco.mjtEq.mjEQ_JOINT,
        objtype=mujoco.mjtObj.mjOBJ_JOINT,
        name1=follower.name,
        name2=f'{side}_gripper',
        solref=_GEAR,
    )
    # Polynomial coefficients: the follower has the position of the other joint.
    gear.data[:2] = 0.0, 1.0
    for pad in (finger, thumb):
        for geom in filter(is_collision, pad.geoms):
            # A priority above that of objects: what the pads touch does not change these values.
            geom.friction, geom.condim, geom.priority = _PAD_FRICTION, 6, 2
            geom.solref = -_PAD_STIFFNESS / period_s**2, -_PAD_DAMPING / period_s
    for one, other in (('finger', 'thumb'), ('forearm', 'palm')):
        spec.add_exclude(bodyname1=f'{side}_{one}', bodyname2=f'{side}_{other}')


def _set_collisions(spec: Any, prefix: str, number: int, self_collision: str) -> None:
    """Set the collision bits of the links; visual geoms collide with nothing."""
    for geom in spec.geoms:
        if is_collision(geom):
            bits = robot_bits(geom.parent.name.removeprefix(prefix), number, self_collision)
            geom.contype, geom.conaffinity = bits.contype, bits.conaffinity
            geom.group = COLLISION_GROUP


def _add_accelerometer(spec: Any, link: str) -> None:
    """Add the accelerometer, whose value is not part of the state."""
    _body(spec, link).add_site(name=ACCELEROMETER)
    spec.add_sensor(
        name=ACCELEROMETER,
        type=mujoco.mjtSensor.mjSENS_ACCELEROMETER,
        objtype=mujoco.mjtObj.mjOBJ_SITE,
        objname=ACCELEROMETER,
    )


def _change_masses(spec: Any, physics: Physics) -> None:
    """Scale the masses and inertias of links."""
    for link, factor in physics.mass_factors.items():
        body = _body(spec, link)
        if not body.mass > 0.0:
            raise SimulationError(f"Link '{link}' has no mass to scale.")
        body.mass *= factor
        body.inertia = body.inertia * factor
        body.fullinertia = body.fullinertia * factor


def spec_of(urdf: str) -> Any:
    """
    Parse a URDF to a MuJoCo specification, with visuals and fixed links kept.

    Parameters
    ----------
    urdf
        Content of the URDF.

    Returns
    -------
    mujoco.MjSpec
        The robot, which can be extended before it is compiled.

    Raises
    ------
    SimulationError
        The text is not XML, a mesh is in an unknown package, or MuJoCo rejects it.

    """
    try:
        robot = ElementTree.fromstring(urdf)
    except ElementTree.ParseError as error:
        raise SimulationError(
            f'The robot cannot be simulated: its URDF is not valid XML: {error}.'
        )
    for old in robot.findall('mujoco'):
        robot.remove(old)
    for mesh in robot.iter('mesh'):
        mesh.set('filename', _mesh_file(mesh.get('filename', '')))
    ElementTree.SubElement(ElementTree.SubElement(robot, 'mujoco'), 'compiler', _KEEP)
    try:
        return mujoco.MjSpec.from_string(ElementTree.tostring(robot, encoding='unicode'))
    except ValueError as error:
        raise SimulationError(
            f'The robot cannot be simulated: MuJoCo rejects its URDF: {error}. Run check_model '
            'for details.'
        ) from error


def _mesh_file(file: str) -> str:
    """Resolve the file name of a mesh; MuJoCo knows neither `package://` nor `file://`."""
    if '://' not in file or is_remote(file):
        return file
    try:
        return str(mesh_path(file, Path()))
    except DescriptionError as error:
        raise SimulationError(
            f"The robot cannot be simulated: the mesh '{file}' was not found: {error}"
        ) from error


@dataclass(frozen=True)
class Bits:
    """Collision bits of a geom, as MuJoCo defines them."""

    contype: int
    conaffinity: int

    def __or__(self, other: Bits) -> Bits:
        """Combine the collision bits of both."""
        return Bits(self.contype | other.contype, self.conaffinity | other.conaffinity)


NOTHING = Bits(0, 0)


def is_collision(geom: Any) -> bool:
    """
    Check whether a geom of a robot came from a collision element of its URDF.

    Parameters
    ----------
    geom
        A geom of a MuJoCo specification, as it was read from a URDF.

    """
    return bool(geom.contype or geom.conaffinity)


def robot_bits(link: str, number: int, self_collision: str) -> Bits:
    """
    Compute the collision bits of a link of a robot.

    Links always collide with the world and with other robots.

    Parameters
    ----------
    link
        Name of the link, without the prefix of the robot.
    number
        Index of the robot, from 0 to `MOST_ROBOTS` - 1.
    self_collision
        A key of `SELF_COLLISIONS`: which links of the robot collide with each other.

    Returns
    -------
    Bits
        For the collision geoms of the link.

    """
    own = 1 << (_FIRST_ROBOT + number)
    bits = Bits(own, WORLD | (_ALL_ROBOTS & ~own))
    if self_collision in ('arms', 'all'):
        bits |= _arm_bits(link)
    if self_collision == 'all':
        bits |= _leg_bits(link)
    return bits


def _arm_bits(link: str) -> Bits:
    """Compute the bits for collisions of arms with each other, the trunk and the thighs."""
    if link.endswith(_ARMS):
        return Bits(_ARM_ON_ARM | _ARM_ON_TRUNK, _ARM_ON_ARM)
    return Bits(0, _ARM_ON_TRUNK) if link in _TRUNK else NOTHING


def _leg_bits(link: str) -> Bits:
    """Compute the bits for collisions of the left leg with the right one."""
    if not link.endswith(_LEGS):
        return NOTHING
    return Bits(_LEG_ON_LEG, 0) if link.startswith('left') else Bits(0, _LEG_ON_LEG)
