# SPDX-License-Identifier: Apache-2.0
"""Check that the links of a robot form one tree."""

from __future__ import annotations

from collections.abc import Sequence

from humanoid_common.naming import did_you_mean
from robot_control.errors import UrdfError
from robot_control.robot_model import RobotModel


def check_tree(model: RobotModel) -> None:
    """
    Check that the links and joints of a robot form a single tree with unique names.

    Parameters
    ----------
    model
        The robot.

    Raises
    ------
    UrdfError
        It has no links, a name twice, a joint at a link that does not exist, several roots, or a
        loop.

    """
    if not model.links:
        raise UrdfError(f"Robot '{model.name}' has no links. Add at least one <link>.")
    _check_unique('link', model.links)
    _check_unique('joint', [joint.name for joint in model.joints])
    for joint in model.joints:
        for link in (joint.parent, joint.child):
            _check_exists(joint.name, link, model.links)
    _check_unique('child', [joint.child for joint in model.joints])
    _check_one_root(model)


def _check_unique(what: str, names: Sequence[str]) -> None:
    """Check that no name occurs twice."""
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice and what == 'child':
        raise UrdfError(f"Link '{twice[0]}' is the child of several joints. Keep one of them.")
    if twice:
        raise UrdfError(f"There are several {what}s named '{twice[0]}'. Rename one of them.")


def _check_exists(joint: str, link: str, links: Sequence[str]) -> None:
    """Check that a joint refers to a link of the robot."""
    if link not in links:
        sentence = f"Joint '{joint}' refers to link '{link}', which does not exist."
        raise UrdfError(' '.join(filter(None, [sentence, did_you_mean(link, links)])))


def _check_one_root(model: RobotModel) -> None:
    """Check that exactly one link is nobody's child, which also excludes loops."""
    children = {joint.child for joint in model.joints}
    roots = [link for link in model.links if link not in children]
    reached = set(roots)
    for _ in model.joints:
        reached |= {joint.child for joint in model.joints if joint.parent in reached}
    if len(roots) > 1:
        raise UrdfError(
            f"Robot '{model.name}' is not a single tree: {', '.join(roots)} have no parent. "
            'Connect them so that only one root remains.'
        )
    if len(reached) < len(model.links):
        loop = ', '.join(link for link in model.links if link not in reached)
        raise UrdfError(f"Robot '{model.name}' has a loop among {loop}. Links must form a tree.")
