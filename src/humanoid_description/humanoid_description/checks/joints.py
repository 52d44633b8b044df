# SPDX-License-Identifier: Apache-2.0
"""Check the types, axes, limits and mimic rules of joints."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from humanoid_common.naming import did_you_mean
from humanoid_description.checks.outcome import Check, count
from humanoid_description.robot import DRIVEN_KINDS, Joint, line_of, named, Robot
import numpy as np

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
