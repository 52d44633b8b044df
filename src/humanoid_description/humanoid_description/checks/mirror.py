# SPDX-License-Identifier: Apache-2.0
"""Check that the right side mirrors the left one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from humanoid_description.mesh_files import bounds
from humanoid_description.robot import Array, Body, Joint, Limits, Link, Robot
import numpy as np

MIRROR = np.diag([1.0, -1.0, 1.0, 1.0])
SIDES = (('left_', 'right_'), ('l_', 'r_'))
TOLERANCE = 1e-6
# Of bounding boxes of visual shapes, since the vertices of meshes are rounded.
LOOKS_M = 1e-4


def look_at_mirror(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Compare each link, its visual shapes, and each joint of the left side with those on the right.

    Parameters
    ----------
    robot
        The model to check; its frames are mirrored in y.

    Returns
    -------
    tuple
        The number of pairs for the report, and a message for each difference.

    """
    links, joints = set(robot.link), set(robot.joint)
    defects = [*_alone(robot, links, 'link'), *_alone(robot, joints, 'joint')]
    link_pairs, joint_pairs = list(_pairs(robot, links)), list(_pairs(robot, joints))
    for left, right in joint_pairs:
        defects += _unlike_joints(robot.joint[left], robot.joint[right])
    for left, right in link_pairs:
        defects += _unlike_links(robot.link[left], robot.link[right])
        defects += _unlike_looks(robot.link[left], robot.link[right], robot.folder)
    return f'{len(link_pairs)} links, {len(joint_pairs)} joints', defects


def counterpart(name: str, prefix: str) -> str | None:
    """
    Return the name of the same part on the other side; None for a part of the middle.

    Parameters
    ----------
    name
        The name of a link or joint.
    prefix
        The prefix of all names of the robot, which comes before `left_`, `l_` and their like.

    """
    own = name.removeprefix(prefix)
    for left, right in SIDES:
        if own.startswith(left):
            return prefix + right + own.removeprefix(left)
        if own.startswith(right):
            return prefix + left + own.removeprefix(right)
    return None


def _alone(robot: Robot, names: set[str], kind: str) -> Iterator[str]:
    """Yield a message for every link or joint without a counterpart on the other side."""
    for name in sorted(names):
        other = counterpart(name, robot.prefix)
        if other and other not in names:
            yield f"The {kind} '{name}' has no counterpart '{other}' on the other side."


def _pairs(robot: Robot, names: set[str]) -> Iterator[tuple[str, str]]:
    """Yield the names on the left side, each with its counterpart."""
    for name in sorted(names):
        other = counterpart(name, robot.prefix)
        if other in names and name.removeprefix(robot.prefix).startswith('l'):
            yield name, str(other)


def _is_mirrored(left: Array, right: Array) -> bool:
    """Check whether a matrix of the right side, (4, 4) or (3, 3), mirrors that of the left."""
    size = len(left)
    mirror = MIRROR[:size, :size]
    tolerance = TOLERANCE * max(1e-3, float(np.abs(left).max()))
    return bool(np.allclose(mirror @ left @ mirror, right, rtol=0, atol=tolerance))


def _unlike_joints(left: Joint, right: Joint) -> Iterator[str]:
    """Yield messages on the differences between two joints."""
    both = f"Joints '{left.name}' and '{right.name}'"
    if left.kind != right.kind:
        yield f'{both} are of different types, {left.kind} and {right.kind}.'
    if not _is_mirrored(left.pose, right.pose):
        yield (
            f'{both} are not at mirrored positions: {_point(left.pose)} and {_point(right.pose)}.'
        )
    if left.is_driven and right.is_driven and not _move_alike(left, right):
        yield f'{both} do not have mirrored limits: {_range(left)} and {_range(right)}.'


def _move_alike(left: Joint, right: Joint) -> bool:
    """Check whether the axes and limits of two joints allow mirrored motions."""
    mirrored = MIRROR[:3, :3] @ left.axis
    # Mirroring reverses the direction of a rotation, but not that of a translation.
    turned = mirrored if left.kind == 'prismatic' else -mirrored
    if np.allclose(right.axis, turned):
        return left.limits == right.limits
    return bool(np.allclose(right.axis, -turned)) and _opposite(left) == right.limits


def _opposite(joint: Joint) -> Limits | None:
    """Return the limits of the same joint with its axis reversed."""
    limits = joint.limits
    return limits and Limits(-limits.upper, -limits.lower, limits.effort, limits.velocity)


def _unlike_links(left: Link, right: Link) -> Iterator[str]:
    """Yield messages on the differences between two links."""
    both = f"Links '{left.name}' and '{right.name}'"
    ours, theirs = left.body, right.body
    if ours is None or theirs is None:
        if ours is not theirs:
            yield f'{both}: only one of them has a mass.'
        return
    if abs(ours.mass_kg - theirs.mass_kg) > TOLERANCE * ours.mass_kg:
        yield f'{both} have different masses, {ours.mass_kg:g} and {theirs.mass_kg:g} kg.'
    if not _is_mirrored(_centre(ours), _centre(theirs)):
        yield (
            f'{both} do not have mirrored centres of mass: {_point(ours.pose)} and '
            f'{_point(theirs.pose)}.'
        )
    if not _is_mirrored(_inertia(ours), _inertia(theirs)):
        yield f'{both} do not have mirrored inertias.'


def _unlike_looks(left: Link, right: Link, folder: Path) -> Iterator[str]:
    """Yield a message if the bounding boxes of the visual shapes of two links are not mirrored."""
    ours, theirs = _boxes(left, folder), _boxes(right, folder)
    mirrored = [np.sort(box * MIRROR.diagonal()[:3], axis=0) for box in ours]
    if len(ours) != len(theirs) or not all(
        any(np.allclose(box, other, rtol=0, atol=LOOKS_M) for other in theirs) for box in mirrored
    ):
        yield f"Links '{left.name}' and '{right.name}' do not have mirrored visual shapes."


def _boxes(link: Link, folder: Path) -> list[Array]:
    """Compute the bounding boxes of the visual shapes of a link, as far as they are known."""
    boxes = (bounds(shape, np.eye(4), folder) for shape in link.visuals)
    return [box for box in boxes if box is not None]


def _centre(body: Body) -> Array:
    """Return the pose of the centre of mass, without its rotation."""
    pose = np.eye(4)
    pose[:3, 3] = body.pose[:3, 3]
    return pose


def _inertia(body: Body) -> Array:
    """Rotate the inertia tensor to the axes of the link."""
    turn = body.pose[:3, :3]
    inertia: Array = turn @ body.inertia_kgm2 @ turn.T
    return inertia


def _point(pose: Array) -> str:
    """Format the position of a pose."""
    return '({:g}, {:g}, {:g})'.format(*np.round(pose[:3, 3], 6))


def _range(joint: Joint) -> str:
    """Format the limits and the axis of a joint."""
    limits = joint.limits
    if limits is None:
        return 'none'
    return (
        f'{limits.lower} to {limits.upper} about {_axis(joint)} with {limits.effort} at '
        f'{limits.velocity}'
    )


def _axis(joint: Joint) -> str:
    """Format the axis of a joint."""
    return '({:g}, {:g}, {:g})'.format(*joint.axis)
