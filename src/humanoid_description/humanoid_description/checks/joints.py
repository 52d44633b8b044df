# SPDX-License-Identifier: Apache-2.0
"""Check that links and joints form a tree, and types, axes, limits and mimic rules of joints."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from humanoid_common.naming import did_you_mean
from humanoid_description.checks.outcome import Check, count
from humanoid_description.robot import DRIVEN_KINDS, Joint, line_of, named, repeated, Robot
import numpy as np


def look_at_names(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Count links and joints, and find duplicate names and unknown links.

    Parameters
    ----------
    robot
        The model to check.

    Returns
    -------
    tuple
        The counts for the report, and a message for each defect.

    """
    found = f'{count(len(robot.links), "link")}, {count(len(robot.joints), "joint")}'
    return found, [*_repeated_names(robot), *_unknown_links(robot)]


def _repeated_names(robot: Robot) -> Iterator[str]:
    """Yield a message for every duplicate name."""
    for kind, parts in (('link', robot.links), ('joint', robot.joints)):
        for name in repeated(part.name for part in parts):
            last = [part for part in parts if part.name == name][-1]
            sentence = f"Several {kind}s are named '{name}'. Give each a unique name."
            yield line_of(last) + sentence


def _unknown_links(robot: Robot) -> Iterator[str]:
    """Yield a message for every parent or child link of a joint that does not exist."""
    for joint in robot.joints:
        for role, link in (('parent', joint.parent), ('child', joint.child)):
            if link not in robot.link:
                hint = did_you_mean(link, robot.link) or 'Add the link or correct the name.'
                where = f"{line_of(joint)}The {role} of joint '{joint.name}'"
                yield f"{where} is '{link}', which does not exist. {hint}"


def look_at_root(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Find the root: the one link that is no joint's child.

    Parameters
    ----------
    robot
        The model to check.

    Returns
    -------
    tuple
        The name of the root for the report, and a message if there are none or several.

    """
    roots = robot.roots
    if len(roots) == 1:
        return roots[0], ()
    if not roots:
        return 'none', (
            'There is no root: every link has a parent. Break the loop.'
            if robot.links
            else 'There are no links: the robot is empty.',
        )
    names = ', '.join(f"'{root}'" for root in roots)
    return f'{len(roots)} roots', (
        f'{line_of(robot.link[roots[1]])}There are {len(roots)} roots: {names}. Connect them by '
        'joints: only one link may have no parent.',
    )


def look_at_tree(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Find links with several parents, and kinematic loops.

    Parameters
    ----------
    robot
        The model to check.

    Returns
    -------
    tuple
        The depth of the tree for the report, and a message for each defect.

    """
    depths = [depth for link in robot.links if (depth := _depth(robot, link.name)) is not None]
    return f'{count(max(depths, default=0), "joint")} deep', [
        *_several_parents(robot),
        *_loops(robot),
    ]


def _several_parents(robot: Robot) -> Iterator[str]:
    """Yield a message for every link with several parent joints."""
    for link in repeated(joint.child for joint in robot.joints):
        holding = [joint for joint in robot.joints if joint.child == link]
        names = ', '.join(f"'{joint.name}'" for joint in holding)
        where = f"{line_of(holding[1])}Link '{link}'"
        yield f'{where} is the child of several joints: {names}. Keep one of them.'


def _loops(robot: Robot) -> Iterator[str]:
    """Yield a message that lists the links in or below a kinematic loop."""
    names = [link.name for link in robot.links if _depth(robot, link.name) is None]
    if names:
        links = ', '.join(f"'{name}'" for name in names)
        where = line_of(robot.joint_above[names[0]])
        yield f'{where}The parents of these links lead into a loop, not to a root: {links}.'


def _depth(robot: Robot, link: str) -> int | None:
    """Return the number of joints from the root to a link; None if there is no root above it."""
    for depth in range(len(robot.joints) + 1):
        if link not in robot.joint_above:
            return depth
        link = robot.joint_above[link].parent
    return None


STRUCTURE = (
    Check('names', look_at_names),
    Check('one root', look_at_root),
    Check('tree', look_at_tree),
)


KINDS = (*DRIVEN_KINDS, 'fixed', 'floating', 'planar')
LIMITED = ('revolute', 'prismatic')


def look_at_kinds(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Find joints of an unknown type or with a zero axis.

    Parameters
    ----------
    robot
        The model to check.

    Returns
    -------
    tuple
        The number of driven joints for the report, and a message for each defect.

    """
    driven = sum(joint.is_driven for joint in robot.joints)
    return f'{driven} driven', [d for joint in robot.joints for d in _wrong_kind(joint)]


def _wrong_kind(joint: Joint) -> Iterator[str]:
    """Yield messages on a wrong type or axis."""
    if joint.kind not in KINDS:
        hint = did_you_mean(joint.kind, KINDS) or f'The types are {", ".join(KINDS)}.'
        where = named(joint)
        yield f"{where} has the unknown type '{joint.kind}'. {hint}"
    if joint.is_driven and not np.linalg.norm(joint.axis) > 0:
        yield f"{line_of(joint)}The axis of joint '{joint.name}' is 0 0 0, which has no direction."


def look_at_limits(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Find missing or swapped joint limits, and effort and velocity limits that are not positive.

    Parameters
    ----------
    robot
        The model to check.

    Returns
    -------
    tuple
        The number of revolute and prismatic joints for the report, and a message for each defect.

    """
    limited = [joint for joint in robot.joints if joint.kind in LIMITED]
    return count(len(limited), 'range'), [d for joint in limited for d in _wrong_limits(joint)]


def _wrong_limits(joint: Joint) -> Iterator[str]:
    """Yield messages on the limits of one joint."""
    limits, where = joint.limits, named(joint)
    if limits is None:
        yield (
            f'{where} is {joint.kind}, but has no <limit> with its range. '
            'Give lower, upper, effort and velocity.'
        )
        return
    if not limits.lower < limits.upper:
        yield (
            f'{where} has the lower limit {limits.lower:g}, which is not below the '
            f'upper limit {limits.upper:g}.'
        )
    for name, value in (('effort', limits.effort), ('velocity', limits.velocity)):
        if not (value or 0) > 0:
            yield (
                f'{where} has {_shown(value)} {name} limit, so it cannot move. '
                'Give a positive one.'
            )


def _shown(value: float | None) -> str:
    """Format the value of a limit for a message."""
    return 'no' if value is None else f'{value:g} as'


def look_at_mimics(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Find mimic joints whose leader is missing or cannot move, and cycles of mimic joints.

    Parameters
    ----------
    robot
        The model to check.

    Returns
    -------
    tuple
        The number of mimic joints for the report, and a message for each defect.

    """
    mimics = {joint.name: joint.mimics.joint for joint in robot.joints if joint.mimics}
    defects = [d for name, leader in mimics.items() for d in _wrong_leader(robot, name, leader)]
    return count(len(mimics), 'follower'), [*defects, *_circles(robot, mimics)]


def _wrong_leader(robot: Robot, name: str, leader: str) -> Iterator[str]:
    """Yield a message if the leader of a mimic joint does not exist or has no position."""
    what = f"{named(robot.joint[name])} mimics '{leader}', which"
    if leader not in robot.joint:
        hint = did_you_mean(leader, robot.joint.keys() - {name}) or 'Correct the name.'
        yield f'{what} does not exist. {hint}'
    elif not robot.joint[leader].is_driven:
        yield f'{what} has no position: it is {robot.joint[leader].kind}.'


def _circles(robot: Robot, mimics: Mapping[str, str]) -> Iterator[str]:
    """Yield a message that lists the mimic joints that lead to a cycle."""
    circling = [name for name in mimics if _leads_nowhere(mimics, name)]
    if circling:
        names = ', '.join(f"'{name}'" for name in circling)
        where = line_of(robot.joint[circling[0]])
        yield (
            f'{where}These joints mimic each other in a loop, so nothing can move them: {names}.'
        )


def _leads_nowhere(mimics: Mapping[str, str], name: str) -> bool:
    """Check whether the leaders of a mimic joint lead to a cycle."""
    for _ in mimics:
        if name not in mimics:
            return False
        name = mimics[name]
    return name in mimics


JOINTS = (
    Check('types and axes', look_at_kinds),
    Check('limits', look_at_limits),
    Check('mimic', look_at_mimics),
)
