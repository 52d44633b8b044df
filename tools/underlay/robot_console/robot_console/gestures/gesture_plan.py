# SPDX-License-Identifier: Apache-2.0
"""How a robot carries out a gesture from where it is: a trajectory for each controller."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
import math

from robot_console.gestures.gesture_file import BodyPose, Gesture, GestureError
from ros_environment.suggestions import did_you_mean
from urdf import Joint

__all__ = ['GesturePlan', 'Motion', 'RobotState', 'common_prefix', 'plan_gesture']

PEAK = 1.5
"""The peak velocity of a cubic polynomial between two points at rest, by its average."""
SLACK = 1e-6


@dataclass(frozen=True)
class RobotState:
    """What a gesture depends on: the joints of a robot, who moves them, and where they are."""

    joints: Mapping[str, Joint]
    """The moving joints of the robot description, by name."""
    controllers: Mapping[str, Sequence[str]]
    """The joints of each active trajectory controller."""
    positions: Mapping[str, float]
    """The measured positions, in rad or m."""


@dataclass(frozen=True)
class Motion:
    """The trajectory of one controller, at rest at each of its points."""

    controller: str
    joints: tuple[str, ...]
    """All joints of the controller."""
    points: tuple[tuple[float, tuple[float, ...]], ...]
    """For each point its time from the start in s, and the positions in rad or m."""


@dataclass(frozen=True)
class GesturePlan:
    """The motions of a gesture, which start together."""

    motions: tuple[Motion, ...]
    body: tuple[tuple[float, BodyPose], ...]
    """The body poses to command, each with its time from the start in s."""
    duration_s: float


def plan_gesture(gesture: Gesture, robot: RobotState, max_velocity: float) -> GesturePlan:
    """
    Plan a gesture from the current positions, within the limits of the joints.

    Each step ends at rest. It takes the time that the gesture gives, or longer if a joint would
    otherwise exceed a velocity limit. Joints that a step does not name stay where they are.

    Parameters
    ----------
    gesture
        The gesture; if all names of joints of the robot have the same prefix, it may be left out.
    robot
        The robot.
    max_velocity
        The maximum velocity of all joints, in rad/s or m/s, besides their own limits.

    Raises
    ------
    GestureError
        A joint does not exist, no controller moves it, its position is not known, or it would
        exceed its range; the message is a full sentence.

    """
    owners = {joint: name for name, own in robot.controllers.items() for joint in own}
    steps = _targets(gesture, robot.joints, owners)
    moved = {joint for targets in steps for joint in targets}
    if not moved and not gesture.bends:
        raise GestureError('No active controller moves any of its joints.')
    motions = {owners[joint]: tuple(robot.controllers[owners[joint]]) for joint in sorted(moved)}
    at = {joint: _start(joint, robot) for own in motions.values() for joint in own}
    points: dict[str, list[tuple[float, tuple[float, ...]]]] = {name: [] for name in motions}
    body: list[tuple[float, BodyPose]] = []
    time_s = 0.0
    for step, targets in zip(gesture.steps, steps):
        if step.body is not None:
            body.append((time_s, step.body))
        time_s += max(
            [step.duration_s]
            + [
                PEAK * abs(target - at[joint]) / _velocity(robot.joints[joint], max_velocity)
                for joint, target in targets.items()
            ]
        )
        at.update(targets)
        for name, own in motions.items():
            points[name].append((time_s, tuple(at[joint] for joint in own)))
    found = tuple(Motion(name, own, tuple(points[name])) for name, own in motions.items())
    return GesturePlan(found, tuple(body), time_s)


def common_prefix(names: Collection[str], joints: Collection[str]) -> str:
    """
    Find the prefix that the joints of a robot have before names that were written without it.

    Parameters
    ----------
    names
        The names as written.
    joints
        The joints of the robot.

    Returns
    -------
    str
        The prefix with which most of the names are joints; '' if it is none, or there is a tie.

    """
    found = {''}
    found.update(
        joint.removesuffix(name) for name in names for joint in joints if joint.endswith(name)
    )
    return max(
        sorted(found, key=len), key=lambda prefix: sum(prefix + name in joints for name in names)
    )


def _targets(
    gesture: Gesture, joints: Mapping[str, Joint], owners: Mapping[str, str]
) -> list[dict[str, float]]:
    """Return the targets of each step by the full names of the joints, all of them possible."""
    names = {name for step in gesture.steps for name in step.joints}
    prefix = common_prefix(names, joints)
    return [
        {
            prefix + name: _checked(joints[prefix + name], target)
            for name, target in step.joints.items()
            if _is_used(name, prefix, gesture, joints, owners)
        }
        for step in gesture.steps
    ]


def _is_used(
    name: str,
    prefix: str,
    gesture: Gesture,
    joints: Mapping[str, Joint],
    owners: Mapping[str, str],
) -> bool:
    """Whether a joint is moved; it is not if it is optional and cannot be."""
    joint = prefix + name
    if joint in joints and joint in owners:
        return True
    if name in gesture.optional_joints:
        return False
    if joint not in joints:
        meant = did_you_mean(joint, joints, 0.75)
        raise GestureError(f"The robot has no joint '{joint}'. {meant}".rstrip())
    raise GestureError(f"No active controller moves '{joint}'.")


def _checked(joint: Joint, target: float) -> float:
    """Return a target that is within the range of its joint."""
    limits = joint.limits
    if limits is not None and not limits.lower - SLACK <= target <= limits.upper + SLACK:
        raise GestureError(
            f"'{joint.name}' would have to go to {target:g}, but its range is from "
            f'{limits.lower:g} to {limits.upper:g}.'
        )
    return target


def _start(joint: str, robot: RobotState) -> float:
    """Return where a joint is, clamped to its range: a joint at a limit may sag beyond it."""
    position = robot.positions.get(joint, math.nan)
    if not math.isfinite(position):
        raise GestureError(f"The position of '{joint}' is not known: no joint state has it.")
    known = robot.joints.get(joint)
    limits = known.limits if known else None
    return min(max(position, limits.lower), limits.upper) if limits else position


def _velocity(joint: Joint, maximum: float) -> float:
    """Return the velocity limit of a joint."""
    return min(joint.max_velocity, maximum) if joint.max_velocity else maximum
