# SPDX-License-Identifier: Apache-2.0
"""Check the reach of the hands."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from humanoid_description.kinematics import chain, pose_along
from humanoid_description.robot import Array, Joint, Robot
import numpy as np

ARMS = (('left', 'l_gripper', 1.0), ('right', 'r_gripper', -1.0))
# Minimum forward reach of a hand, as a fraction of the arm length.
FORWARD = 0.8
SAMPLES = 6000


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
