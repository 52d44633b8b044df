# SPDX-License-Identifier: Apache-2.0
"""Read a URDF."""

from __future__ import annotations

from collections.abc import Iterator
import math
from xml.etree import ElementTree

from robot_control.errors import UrdfError
from robot_control.robot_model import Joint, RobotModel
from robot_control.tree import check_tree

_LIMITED = ('revolute', 'prismatic')
_KINDS = (*_LIMITED, 'continuous', 'fixed', 'floating', 'planar')


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
    check_tree(model)
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
