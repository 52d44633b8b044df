# SPDX-License-Identifier: Apache-2.0
"""What a URDF says about a robot: its links and joints, read and checked to form one tree."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
import math
from xml.etree import ElementTree

from humanoid_common.errors import UserError
from humanoid_common.naming import did_you_mean

_LIMITED = ('revolute', 'prismatic')
_KINDS = (*_LIMITED, 'continuous', 'fixed', 'floating', 'planar')


@dataclass(frozen=True)
class Joint:
    """A joint; the limits are None where its type has none."""

    name: str
    kind: str
    parent: str
    child: str
    lower: float | None = None
    upper: float | None = None

    def describe(self) -> str:
        """Return the joint in words."""
        words = f'{self.name}: {self.kind}, {self.parent} -> {self.child}'
        if self.lower is None or self.upper is None:
            return words
        unit = 'm' if self.kind == 'prismatic' else 'rad'
        return f'{words}, {self.lower:g} to {self.upper:g} {unit}'


@dataclass(frozen=True)
class RobotModel:
    """A robot: its links and the joints between them."""

    name: str
    links: tuple[str, ...]
    joints: tuple[Joint, ...]

    def describe(self) -> list[str]:
        """Return the robot in words, one line for the whole and one for each joint."""
        summary = (
            f"Loaded robot '{self.name}': {len(self.links)} links "
            f'({", ".join(self.links)}), {len(self.joints)} joints'
        )
        return [summary, *(f'  {joint.describe()}' for joint in self.joints)]


class UrdfError(UserError):
    """Refuse a URDF, with the reason."""


def parse_urdf(text: str) -> RobotModel:
    """
    Parse a URDF into a robot model, and check that its links form a tree.

    Parameters
    ----------
    text
        The content of a URDF file.

    Raises
    ------
    UrdfError
        The text is no valid URDF; the error says why, and what to do.

    """
    robot = _robot_element(text)
    model = RobotModel(
        _attribute(robot, 'name', 'the robot'),
        tuple(_attribute(link, 'name', 'a link') for link in robot.findall('link')),
        tuple(_joints(robot)),
    )
    _check_tree(model)
    return model


def _robot_element(text: str) -> ElementTree.Element:
    """Parse the XML and check its root."""
    if not text.strip():
        raise UrdfError('The robot description is empty. Pass the text of a URDF file.')
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise UrdfError(
            f'The robot description is not valid XML: {error}. Correct the URDF there.',
        ) from error
    if root.tag != 'robot':
        raise UrdfError(
            f'The robot description starts with <{root.tag}>, but a URDF starts with <robot>.'
        )
    return root


def _joints(robot: ElementTree.Element) -> Iterator[Joint]:
    """Read the joints; those inside other elements, such as <transmission>, do not count."""
    for element in robot.findall('joint'):
        name = _attribute(element, 'name', 'a joint')
        where = f"joint '{name}'"
        kind = _attribute(element, 'type', where)
        if kind not in _KINDS:
            raise UrdfError(
                f"The type of {where} is '{kind}', but must be one of {', '.join(_KINDS)}."
            )
        lower, upper = _limits(element, where) if kind in _LIMITED else (None, None)
        parent = _attribute(_child(element, 'parent', where), 'link', f'the parent of {where}')
        child = _attribute(_child(element, 'child', where), 'link', f'the child of {where}')
        yield Joint(name, kind, parent, child, lower, upper)


def _limits(joint: ElementTree.Element, where: str) -> tuple[float, float]:
    """Read the limits of a joint; a limit that is not given is zero."""
    limit = _child(joint, 'limit', where)
    lower, upper = (_number(limit, side, where) for side in ('lower', 'upper'))
    if lower > upper:
        raise UrdfError(
            f'The lower limit of {where} is {lower:g}, but must not exceed the upper one, '
            f'which is {upper:g}.'
        )
    return lower, upper


def _number(element: ElementTree.Element, attribute: str, where: str) -> float:
    """Read an attribute that holds a number."""
    text = element.get(attribute, '0')
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise UrdfError(f"The {attribute} limit of {where} is '{text}', but must be a number.")
    return number


def _child(element: ElementTree.Element, tag: str, where: str) -> ElementTree.Element:
    """Return the child element that must be there."""
    found = element.find(tag)
    if found is None:
        raise UrdfError(f'There is no <{tag}> in {where}. Add it to the URDF.')
    return found


def _attribute(element: ElementTree.Element, name: str, where: str) -> str:
    """Return the attribute that must be there."""
    value = element.get(name, '')
    if not value:
        raise UrdfError(f"There is no attribute '{name}' in {where}. Add it to the URDF.")
    return value


def _check_tree(model: RobotModel) -> None:
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
