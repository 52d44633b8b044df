# SPDX-License-Identifier: Apache-2.0
"""Check the names, symmetry, height, mass, stability and reach of the humanoid."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from humanoid_common.naming import did_you_mean
from humanoid_description.checks.build import (
    build_of,
    ground_contact,
    has_hands,
    has_legs,
    height_m,
)
from humanoid_description.checks.mirror import look_at_mirror
from humanoid_description.checks.outcome import Check
from humanoid_description.checks.shells import look_at_shells
from humanoid_description.drives import load_drives, load_scaling
from humanoid_description.geometry import centre_of_mass, margin_inside
from humanoid_description.kinematics import chain, pose_along, poses
from humanoid_description.robot import Array, Joint, Robot
import numpy as np

# Relative, for height and mass: the model is exact, but a file may be rounded to few digits.
TOLERANCE = 0.01
ARMS = (('left', 'l_gripper', 1.0), ('right', 'r_gripper', -1.0))
# Minimum forward reach of a hand, as a fraction of the arm length.
FORWARD = 0.8
SAMPLES = 6000


def look_at_frames(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Find frames of REP 120 that are missing.

    Parameters
    ----------
    robot
        The model to check.

    Returns
    -------
    tuple
        How many of the frames there are, for the report, and a message for each missing one.

    """
    wanted = [robot.prefix + name for name in build_of(robot).frames]
    missing = [name for name in wanted if name not in robot.link]
    return f'{len(wanted) - len(missing)} of {len(wanted)}', [
        f"The frame '{name}' of REP 120 is missing. "
        + did_you_mean(name, set(robot.link) - set(wanted))
        for name in missing
    ]


def look_at_driven_joints(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Find driven joints of config/joints.yaml that are missing.

    Parameters
    ----------
    robot
        The model to check.

    Returns
    -------
    tuple
        How many of the joints there are, for the report, and a message for each missing one.

    """
    wanted = load_drives(
        prefix=robot.prefix, upper_body_only=not has_legs(robot), hands=has_hands(robot)
    )
    driven = {joint.name for joint in robot.joints if joint.is_driven}
    missing = [name for name in wanted if name not in driven]
    return f'{len(wanted) - len(missing)} of {len(wanted)}', [
        f"The driven joint '{name}' of config/joints.yaml is missing. "
        + did_you_mean(name, driven - set(wanted))
        for name in missing
    ]


def look_at_ground_contact(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Check that there is a support polygon: more than two lowest corners.

    Parameters
    ----------
    robot
        The model to check.

    Returns
    -------
    tuple
        The number of corners for the report, and a message if there are too few.

    """
    corners = len(ground_contact(robot))
    defect = (
        'There is no flat surface to stand on: add a <collision> other than a mesh to '
        f'{", ".join(build_of(robot).stands_on)}.'
    )
    return f'{corners} corners', () if corners > 2 else (defect,)


def look_at_height(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Check that the height is within the range that the scale of the model allows.

    Parameters
    ----------
    robot
        The model to check.

    Returns
    -------
    tuple
        The height (m) for the report, and a message if it is out of range.

    """
    height, rules = height_m(robot), load_scaling()
    low, high = (build_of(robot).height_m * scale for scale in (rules.smallest, rules.largest))
    defect = (
        f'The robot is {height:.2f} m tall; this build is designed for {low:.2f} to {high:.2f} m.'
    )
    is_right = low * (1 - TOLERANCE) <= height <= high * (1 + TOLERANCE)
    return f'{height:.3f} m', () if is_right else (defect,)


def look_at_mass(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Compare the total mass with that of the humanoid scaled to this height.

    Parameters
    ----------
    robot
        The model to check.

    Returns
    -------
    tuple
        The mass (kg) for the report, and a message if it is off by more than 1 %.

    """
    build, height = build_of(robot), height_m(robot)
    power = load_scaling().exponents['mass']
    wanted = build.mass_kg * (height / build.height_m) ** power
    defect = (
        f'The robot weighs {robot.mass_kg:.2f} kg; at its height of {height:.2f} m it should '
        f'weigh {wanted:.2f} kg.'
    )
    is_right = abs(robot.mass_kg - wanted) <= TOLERANCE * wanted
    return f'{robot.mass_kg:.3f} kg', () if is_right else (defect,)


def look_at_stand(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Check static stability: the centre of mass above the support polygon, all joints at zero.

    Parameters
    ----------
    robot
        The model to check.

    Returns
    -------
    tuple
        The margin (mm) for the report, and a message if the robot tips over.

    """
    ground = ground_contact(robot)
    centre = centre_of_mass(robot, poses(robot))
    margin_mm = 1000 * margin_inside(centre[:2], ground[:, :2])
    if margin_mm > 0:
        return f'centre of mass {margin_mm:.0f} mm inside', ()
    return f'centre of mass {-margin_mm:.0f} mm outside', (
        f'The centre of mass, at x {centre[0]:.3f} y {centre[1]:.3f}, is {-margin_mm:.0f} mm '
        'outside the support polygon: with all joints at zero, the robot tips over.',
    )


@dataclass(frozen=True)
class HandReach:
    """Reach of a hand: forward of the shoulder, and distance to the sagittal plane in front."""

    arm_m: float
    forward_m: float
    to_middle_m: float


def look_at_reach(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Sample postures of each arm within its joint limits, and measure how far the hands reach.

    Parameters
    ----------
    robot
        The model to check.

    Returns
    -------
    tuple
        The reach (m) forward of the shoulder, that of the worse arm, for the report; and a message
        for each hand that reaches too little forward, or not to the middle.

    """
    reaches = {side: _reach(robot, frame, sign) for side, frame, sign in ARMS}
    found = min(reach.forward_m for reach in reaches.values())
    defects = [d for side, reach in reaches.items() for d in _too_short(side, reach)]
    return f'{found:.2f} m forward', defects


def _too_short(side: str, reach: HandReach) -> Iterator[str]:
    """Yield messages if the reach of a hand is too short."""
    if reach.forward_m < FORWARD * reach.arm_m:
        yield (
            f'The {side} hand reaches only {reach.forward_m:.2f} m forward of the shoulder, with '
            f'an arm of {reach.arm_m:.2f} m. Check the limits of the shoulder and the elbow.'
        )
    if reach.to_middle_m > 0:
        yield (
            f'The {side} hand stays {reach.to_middle_m:.2f} m from the midline of the body: '
            'the hands cannot meet in front of it.'
        )


def _reach(robot: Robot, frame: str, sign: float) -> HandReach:
    """Compute the reach of the hand of a side; the sign is that of the side's y."""
    joints = chain(robot, robot.prefix + frame, robot.prefix + 'torso')
    shoulder, arm_m = joints[0].pose[:3, 3], _length(joints[1:])
    hands = pose_along(joints, _postures(joints))[..., :3, 3].reshape(-1, 3)
    forward = hands[:, 0] - shoulder[0]
    in_front = hands[forward > arm_m / 4]
    nearest = (sign * in_front[:, 1]).min() if len(in_front) else sign * shoulder[1]
    return HandReach(arm_m, float(forward.max()), float(nearest))


def _length(joints: list[Joint]) -> float:
    """Compute the length of a chain."""
    return float(sum(np.linalg.norm(joint.pose[:3, 3]) for joint in joints))


def _postures(joints: list[Joint]) -> dict[str, Array]:
    """Sample the ranges of all joints on a grid."""
    driven = [joint for joint in joints if joint.is_driven]
    count = max(3, round(SAMPLES ** (1 / max(1, len(driven)))))
    grid = np.meshgrid(*(_samples(joint, count) for joint in driven))
    return {joint.name: values.ravel() for joint, values in zip(driven, grid)}


def _samples(joint: Joint, count: int) -> Array:
    """Sample the range of a joint evenly, and add zero."""
    limits = joint.limits
    if limits is None or joint.kind == 'continuous':
        return np.linspace(-np.pi, np.pi, count)
    ends = limits.lower, limits.upper
    return np.append(np.linspace(*ends, count), np.clip(0.0, *ends))


NAMES = (
    Check('frames of REP 120', look_at_frames),
    Check('driven joints', look_at_driven_joints),
    Check('ground contact', look_at_ground_contact),
)
SHAPE = (
    Check('mirror symmetry', look_at_mirror),
    Check('shells', look_at_shells),
    Check('height', look_at_height),
    Check('total mass', look_at_mass),
    Check('stand', look_at_stand),
    Check('reach', look_at_reach),
)
