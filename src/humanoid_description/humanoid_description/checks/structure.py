# SPDX-License-Identifier: Apache-2.0
"""Check that links and joints form a tree."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from humanoid_common.naming import did_you_mean
from humanoid_description.checks.outcome import Check, count
from humanoid_description.robot import line_of, repeated, Robot


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
