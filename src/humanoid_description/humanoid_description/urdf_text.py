# SPDX-License-Identifier: Apache-2.0
"""Validate the XML of a URDF; errors give the line."""

from __future__ import annotations

from collections.abc import Iterator
import math
from typing import Any

from humanoid_description.errors import DescriptionError

# Required number of values of numeric attributes, by element.
NUMBERS = {
    'origin': {'xyz': 3, 'rpy': 3},
    'axis': {'xyz': 3},
    'limit': {'lower': 1, 'upper': 1, 'effort': 1, 'velocity': 1},
    'mass': {'value': 1},
    'inertia': dict.fromkeys(('ixx', 'ixy', 'ixz', 'iyy', 'iyz', 'izz'), 1),
    'box': {'size': 3},
    'cylinder': {'radius': 1, 'length': 1},
    'sphere': {'radius': 1},
    'mesh': {'scale': 3},
    'color': {'rgba': 4},
    'dynamics': {'damping': 1, 'friction': 1},
    'mimic': {'multiplier': 1, 'offset': 1},
    'calibration': {'rising': 1, 'falling': 1},
    'safety_controller': dict.fromkeys(
        ('soft_lower_limit', 'soft_upper_limit', 'k_position', 'k_velocity'), 1
    ),
}
# Required attributes and child elements, by element.
ATTRIBUTES = {
    'robot': ('name',),
    'link': ('name',),
    'joint': ('name', 'type'),
    'parent': ('link',),
    'child': ('link',),
    'mimic': ('joint',),
    'mass': ('value',),
    'inertia': tuple(NUMBERS['inertia']),
    'box': ('size',),
    'cylinder': ('radius', 'length'),
    'sphere': ('radius',),
    'mesh': ('filename',),
}
ELEMENTS = {
    'joint': ('parent', 'child'),
    'inertial': ('mass', 'inertia'),
    'visual': ('geometry',),
    'collision': ('geometry',),
}
# Extensions, whose child elements have other meanings than in a URDF: they are skipped.
FOREIGN = ('gazebo', 'transmission', 'ros2_control', 'mujoco')
SHAPES = ('box', 'cylinder', 'sphere', 'mesh')


def readable(text: str, source: str) -> Any:
    """
    Parse and validate the XML of a URDF.

    Parameters
    ----------
    text
        The URDF.
    source
        The name of the URDF in error messages.

    Returns
    -------
    Any
        The lxml element `robot`.

    Raises
    ------
    DescriptionError
        The text is not XML, not a URDF, or has an invalid element; the message gives the line.

    """
    from lxml import etree

    try:
        robot = etree.fromstring(text.encode())
    except etree.XMLSyntaxError as error:
        raise DescriptionError(f'{source} is not valid XML: {error.msg}.') from error
    if robot.tag != 'robot':
        raise DescriptionError(
            f'{source} is not a URDF: its root element is <{robot.tag}> instead of <robot>.'
        )
    for element in _elements(robot):
        for problem in _problems(element):
            where = f'{source}, line {element.sourceline}'
            raise DescriptionError(f'{where}: {_owner(element)}{problem}')
    return robot


def _elements(element: Any) -> Iterator[Any]:
    """Yield the elements of the URDF, without extensions."""
    if not isinstance(element.tag, str) or element.tag in FOREIGN:
        return
    yield element
    for child in element:
        yield from _elements(child)


def _problems(element: Any) -> Iterator[str]:
    """Yield messages on missing items, values that are not numbers, and unexpanded xacro."""
    if element.prefix == 'xacro':
        tag = f'xacro:{element.tag.rpartition("}")[2]}'
        yield f'<{tag}> is xacro, not URDF. Expand the file first, or name it *.xacro.'
    for attribute in ATTRIBUTES.get(element.tag, ()):
        if not element.get(attribute):
            yield f"<{element.tag}> lacks the attribute '{attribute}'."
    for tag in ELEMENTS.get(element.tag, ()):
        if element.find(tag) is None:
            yield f'<{element.tag}> lacks the element <{tag}>.'
    if element.tag == 'geometry' and [child.tag in SHAPES for child in element] != [True]:
        yield f'<geometry> must hold exactly one of {", ".join(SHAPES)}.'
    for attribute, count in NUMBERS.get(element.tag, {}).items():
        if attribute in element.attrib and not _are_numbers(element.get(attribute), count):
            yield (
                f"<{element.tag}> has {attribute}='{element.get(attribute)}', "
                f'which is not {_count(count)}.'
            )


def _are_numbers(text: str, count: int) -> bool:
    """Check whether a text consists of a given count of finite numbers."""
    try:
        numbers = [float(part) for part in text.split()]
    except ValueError:
        return False
    return len(numbers) == count and all(map(math.isfinite, numbers))


def _count(count: int) -> str:
    """Format the required number of values."""
    return 'a number' if count == 1 else f'{count} numbers'


def _owner(element: Any) -> str:
    """Format the name of the link or joint that an element belongs to."""
    for ancestor in (element, *element.iterancestors()):
        if ancestor.tag in ('link', 'joint') and ancestor.get('name'):
            return f"{ancestor.tag} '{ancestor.get('name')}': "
    return ''
