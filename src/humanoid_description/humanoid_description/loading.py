# SPDX-License-Identifier: Apache-2.0
"""Parse a URDF to a robot model; errors in its XML give the line."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
import math
from pathlib import Path
from typing import Any

from humanoid_description.errors import DescriptionError
from humanoid_description.robot import Array, Body, Joint, Limits, Link, Mimic, Robot, Shape
from humanoid_description.rotations import from_rpy
import numpy as np

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
FORWARD = (1.0, 0.0, 0.0)
"""The default axis of a joint."""


def load_robot(text: str, source: str, folder: Path = Path()) -> Robot:
    """
    Parse a URDF.

    Parameters
    ----------
    text
        The URDF, as XML.
    source
        The name of the URDF in error messages.
    folder
        The folder to which mesh file names without a scheme are relative.

    Returns
    -------
    Robot
        The model, not validated; see `checks.check_robot`.

    Raises
    ------
    DescriptionError
        The text is not a URDF; the message gives the line.

    """
    robot = readable(text, source)
    return Robot(
        robot.get('name'),
        tuple(map(_link, robot.findall('link'))),
        tuple(map(_joint, robot.findall('joint'))),
        folder,
    )


def _link(link: Any) -> Link:
    """Build a link."""
    inertial = link.find('inertial')
    return Link(
        link.get('name'),
        None if inertial is None else _body(inertial),
        tuple(map(_shape, link.findall('visual'))),
        tuple(map(_shape, link.findall('collision'))),
        link.sourceline,
    )


def _body(inertial: Any) -> Body:
    """Build the inertial parameters of a link."""
    inertia = inertial.find('inertia')
    xx, xy, xz, yy, yz, zz = (
        float(inertia.get(name)) for name in ('ixx', 'ixy', 'ixz', 'iyy', 'iyz', 'izz')
    )
    return Body(
        float(inertial.find('mass').get('value')),
        _pose(inertial),
        np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]),
    )


def _shape(element: Any) -> Shape:
    """Build the shape of a visual or collision element."""
    geometry, pose = element.find('geometry')[0], _pose(element)
    if geometry.tag == 'box':
        return Shape('box', tuple(_numbers(geometry.get('size'))), pose)
    if geometry.tag == 'cylinder':
        size_m = float(geometry.get('radius')), float(geometry.get('length'))
        return Shape('cylinder', size_m, pose)
    if geometry.tag == 'sphere':
        return Shape('sphere', (float(geometry.get('radius')),), pose)
    scale = _numbers(geometry.get('scale'), (1.0, 1.0, 1.0))
    return Shape('mesh', tuple(scale), pose, geometry.get('filename'))


def _joint(joint: Any) -> Joint:
    """Build a joint."""
    axis, limit, mimic = (joint.find(tag) for tag in ('axis', 'limit', 'mimic'))
    return Joint(
        joint.get('name'),
        joint.get('type'),
        joint.find('parent').get('link'),
        joint.find('child').get('link'),
        _pose(joint),
        np.array(FORWARD if axis is None else _numbers(axis.get('xyz'), FORWARD)),
        None if limit is None else _limits(limit),
        None if mimic is None else _mimic(mimic),
        joint.sourceline,
    )


def _mimic(mimic: Any) -> Mimic:
    """Build the mimic rule of a joint."""
    return Mimic(
        mimic.get('joint'), float(mimic.get('multiplier', 1.0)), float(mimic.get('offset', 0.0))
    )


def _limits(limit: Any) -> Limits:
    """Build the limits of a joint; a missing position limit is zero."""
    lower, upper, effort, velocity = (
        None if limit.get(name) is None else float(limit.get(name))
        for name in ('lower', 'upper', 'effort', 'velocity')
    )
    return Limits(lower or 0.0, upper or 0.0, effort, velocity)


def _pose(element: Any) -> Array:
    """Return the pose (4, 4) of an element; the identity if it has no origin."""
    pose: Array = np.eye(4)
    origin = element.find('origin')
    if origin is not None:
        pose[:3, :3] = from_rpy(*_numbers(origin.get('rpy'), (0.0, 0.0, 0.0)))
        pose[:3, 3] = _numbers(origin.get('xyz'), (0.0, 0.0, 0.0))
    return pose


def _numbers(text: str | None, default: Sequence[float] = ()) -> Sequence[float]:
    """Parse the numbers of an attribute; return the default if it is missing."""
    return default if text is None else [float(part) for part in text.split()]


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
