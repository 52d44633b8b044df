# SPDX-License-Identifier: Apache-2.0
"""Nominal values of the humanoid, with and without legs, and measurements of a model."""

from __future__ import annotations

from dataclasses import dataclass, replace

from humanoid_description.geometry import outline
from humanoid_description.kinematics import chain, poses
from humanoid_description.robot import Array, Robot
import numpy as np

NAME = 'humanoid'
SOLES = ('l_sole', 'r_sole')
LEG_FRAMES = ('l_ankle', 'r_ankle', *SOLES)
# Frame names of REP 120.
BODY_FRAMES = ('base_link', 'torso', 'gaze', 'l_wrist', 'r_wrist', 'l_gripper', 'r_gripper')
# Flatness tolerance of a sole, as a fraction of the extent of the feet.
LEVEL = 1e-3
LEG_JOINTS = ('hip', 'knee', 'ankle')
HAND_JOINTS = ('wrist_yaw', 'wrist_pitch', 'gripper')


@dataclass(frozen=True)
class Build:
    """Nominal values of the humanoid at scale 1: height above the ground, mass and frames."""

    height_m: float
    mass_kg: float
    frames: tuple[str, ...]
    stands_on: tuple[str, ...]


WHOLE = Build(1.35, 42.8, BODY_FRAMES + LEG_FRAMES, SOLES)
UPPER_BODY = Build(0.68, 26.2, BODY_FRAMES, ('base_link',))
HANDS_KG = 0.5
"""The mass of two hands in excess of that of the stumps without them."""


def has_legs(robot: Robot) -> bool:
    """
    Check whether the model has any leg joint.

    Parameters
    ----------
    robot
        The model, whose joint names are searched for hip, knee and ankle.

    """
    names = [joint.name for joint in robot.joints]
    return any(part in name for name in names for part in LEG_JOINTS)


def has_hands(robot: Robot) -> bool:
    """
    Check whether the model has any driven wrist or gripper joint.

    Parameters
    ----------
    robot
        The model, whose joint names are searched.

    """
    driven = [joint.name for joint in robot.joints if joint.is_driven]
    return any(part in name for name in driven for part in HAND_JOINTS)


def build_of(robot: Robot) -> Build:
    """
    Return the nominal height, mass and frames, at scale 1, of a humanoid of this build.

    Parameters
    ----------
    robot
        The model, whose joints determine whether it has legs and hands.

    """
    build = WHOLE if has_legs(robot) else UPPER_BODY
    return replace(build, mass_kg=build.mass_kg + HANDS_KG) if has_hands(robot) else build


def ground_contact(robot: Robot) -> Array:
    """
    Compute the corners at which the robot stands on the ground, with all joints at zero.

    Parameters
    ----------
    robot
        A model whose links and joints make a tree.

    Returns
    -------
    Array
        The lowest corners (n, 3) in m of the collision shapes of the feet, or of the base without
        legs, in the frame of the root. Meshes have none.

    """
    at = poses(robot)
    names = {_rigid(robot, robot.prefix + name) for name in build_of(robot).stands_on}
    corners = np.vstack([outline(robot.link[name].collisions, at[name]) for name in names])
    if not len(corners):
        return corners
    size_m = np.ptp(corners, axis=0).max()
    lowest: Array = corners[corners[:, 2] < corners[:, 2].min() + LEVEL * size_m]
    return lowest


def _rigid(robot: Robot, link: str) -> str:
    """Return the moving link that a frame is fixed to."""
    above = [joint for joint in chain(robot, link) if joint.kind != 'fixed']
    return above[-1].child if above else robot.roots[0]


def height_m(robot: Robot) -> float:
    """
    Compute the height in m from the ground to the crown, with all joints at zero.

    All visual and collision shapes count but meshes.

    Parameters
    ----------
    robot
        A model with ground contact.

    """
    at, ground = poses(robot), ground_contact(robot)
    corners = np.vstack(
        [outline((*link.visuals, *link.collisions), at[link.name]) for link in robot.links]
    )
    return float(corners[:, 2].max() - ground[:, 2].min())
