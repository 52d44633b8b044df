# SPDX-License-Identifier: Apache-2.0
"""Validate that the links of a robot form one tree and that its mimic joints are valid."""

from __future__ import annotations

from collections.abc import Sequence

from urdf.did_you_mean import did_you_mean
from urdf.following import check_for_loops
from urdf.joint import Joint
from urdf.robot_model import Link, RobotModel
from urdf.urdf_error import UrdfError

__all__ = ['check_consistency']


def check_consistency(model: RobotModel) -> None:
    """
    Validate a robot: unique names, one tree of links, and mimic joints that exist.

    Parameters
    ----------
    model
        The robot.

    Raises
    ------
    UrdfError
        The robot has no links, or is not consistent.

    """
    if not model.links:
        raise UrdfError(f"Robot '{model.name}' has no links. Add at least one <link>.")
    _check_unique('link', model.links)
    _check_unique('joint', model.joints)
    _check_links_exist(model)
    _check_one_parent(model)
    _check_one_root(model)
    _check_mimics(model)


def _check_unique(what: str, named: Sequence[Link] | Sequence[Joint]) -> None:
    first: dict[str, int | None] = {}
    for each in named:
        if each.name in first:
            raise UrdfError(
                f"There is a {what} '{each.name}' already, on line {first[each.name]}. "
                'Rename one of them.',
                each.line,
            )
        first[each.name] = each.line


def _check_links_exist(model: RobotModel) -> None:
    names = {link.name for link in model.links}
    for joint in model.joints:
        for role, link in (('parent', joint.parent), ('child', joint.child)):
            if link not in names:
                raise UrdfError(
                    f"The {role} of joint '{joint.name}' is link '{link}', which does not "
                    f'exist.{did_you_mean(link, names)}',
                    joint.line,
                )


def _check_one_parent(model: RobotModel) -> None:
    above: dict[str, str] = {}
    for joint in model.joints:
        if joint.child in above:
            raise UrdfError(
                f"Link '{joint.child}' is the child of two joints, '{above[joint.child]}' and "
                f"'{joint.name}'. Remove one of them.",
                joint.line,
            )
        above[joint.child] = joint.name


def _check_one_root(model: RobotModel) -> None:
    """Check that there is exactly one root link, and that all other links are below it."""
    children = {joint.child for joint in model.joints}
    roots = [link for link in model.links if link.name not in children]
    if len(roots) > 1:
        names = ', '.join(f"'{link.name}'" for link in roots)
        raise UrdfError(
            f"Robot '{model.name}' falls apart: the links {names} have no parent. "
            'Join them, so that only one root is left.',
            roots[1].line,
        )
    hanging = _below(model, {link.name for link in roots})
    loop = [joint for joint in model.joints if joint.child not in hanging]
    if loop:
        names = ', '.join(f"'{joint.name}'" for joint in loop)
        raise UrdfError(
            f'The joints {names} go round in a loop. The links of a robot must form a tree.',
            loop[0].line,
        )


def _below(model: RobotModel, roots: set[str]) -> set[str]:
    """Return the links in the subtrees of the given root links, including the roots."""
    children: dict[str, list[str]] = {}
    for joint in model.joints:
        children.setdefault(joint.parent, []).append(joint.child)
    found, waiting = set(roots), list(roots)
    while waiting:
        for child in children.get(waiting.pop(), []):
            found.add(child)
            waiting.append(child)
    return found


def _check_mimics(model: RobotModel) -> None:
    """Check that mimicked joints exist and move, and that mimic joints form no loops."""
    by_name = {joint.name: joint for joint in model.joints}
    mimics = model.mimics
    for name, mimic in mimics.items():
        line, master = by_name[name].line, by_name.get(mimic.joint)
        if master is None:
            meant = did_you_mean(mimic.joint, (other for other in by_name if other != name))
            raise UrdfError(
                f"Joint '{name}' mimics joint '{mimic.joint}', which does not exist.{meant}", line
            )
        if not master.moves:
            raise UrdfError(
                f"Joint '{name}' mimics joint '{master.name}', which has no position: "
                f'it is {master.kind}.',
                line,
            )
    try:
        check_for_loops(mimics)
    except ValueError as loop:
        first = by_name[str(loop).split(' -> ')[0]]
        raise UrdfError(f'Joints mimic each other in a loop: {loop}.', first.line) from loop
