# SPDX-License-Identifier: Apache-2.0
"""Parse the joints, the masses, and the visual and collision shapes of a URDF."""

from __future__ import annotations

from collections.abc import Callable, Mapping
import math

from ros_environment.suggestions import did_you_mean
from urdf.robot_model import (
    Box,
    Capsule,
    Color,
    Cylinder,
    Geometry,
    Joint,
    KINDS,
    LIMITED,
    Limits,
    Mesh,
    Mimic,
    MOVING,
    Shape,
    Sphere,
    Vector,
)
from urdf.xml_element import child, number, origin_of, text, UrdfError, vector, XmlElement

__all__ = ['read_joint', 'read_mass', 'read_materials', 'read_shapes']


def read_joint(element: XmlElement) -> Joint:
    """
    Parse a `<joint>` element.

    Parameters
    ----------
    element
        The element.

    Raises
    ------
    UrdfError
        An attribute or child element is missing or invalid.

    """
    name = text(element, 'name', 'this <joint>')
    where = f"joint '{name}'"
    kind = _kind(element, where)
    return Joint(
        name,
        kind,
        parent=text(child(element, 'parent', where), 'link', f'<parent> of {where}'),
        child=text(child(element, 'child', where), 'link', f'<child> of {where}'),
        origin=origin_of(element, where),
        axis=_axis(element, where) if kind in MOVING else Joint.axis,
        limits=_limits(element, where) if kind in LIMITED else None,
        soft_limits=_soft_limits(element, where) if kind in LIMITED else None,
        mimic=_mimic(element, where),
        max_velocity=_maximum(element, 'velocity', where) if kind in MOVING else None,
        max_effort=_maximum(element, 'effort', where) if kind in MOVING else None,
        line=element.line,
    )


def _kind(element: XmlElement, where: str) -> str:
    kind = text(element, 'type', where)
    if kind not in KINDS:
        raise UrdfError(
            f"The type of {where} is '{kind}', but must be one of {', '.join(KINDS)}. "
            f'{did_you_mean(kind, KINDS, 0.75)}'.rstrip(),
            element.line,
        )
    return kind


def _axis(element: XmlElement, where: str) -> Vector:
    """Parse and normalize the axis; the default is x."""
    axis = element.find('axis')
    x, y, z = vector(axis, 'xyz', where, Joint.axis)
    length = math.hypot(x, y, z)
    if axis is not None and length == 0.0:
        raise UrdfError(f'The axis of {where} is zero, so it has no direction.', axis.line)
    return x / length, y / length, z / length


def _limits(element: XmlElement, where: str) -> Limits:
    """Parse the position limits; a missing one is zero."""
    limit = child(element, 'limit', where)
    return Limits(number(limit, 'lower', where, 0.0), number(limit, 'upper', where, 0.0))


def _maximum(element: XmlElement, name: str, where: str) -> float | None:
    """Parse the velocity or effort limit; 0 and infinity mean unlimited or unknown."""
    limit = element.find('limit')
    if limit is None or 'inf' in limit.attributes.get(name, '').lower():
        return None
    maximum = number(limit, name, where, 0.0)
    return maximum if maximum > 0.0 else None


def _soft_limits(element: XmlElement, where: str) -> Limits | None:
    """Parse the soft limits of the safety controller; a missing one is infinite."""
    safety = element.find('safety_controller')
    if safety is None:
        return None
    return Limits(
        number(safety, 'soft_lower_limit', where, -math.inf),
        number(safety, 'soft_upper_limit', where, math.inf),
    )


def _mimic(element: XmlElement, where: str) -> Mimic | None:
    mimic = element.find('mimic')
    if mimic is None:
        return None
    return Mimic(
        text(mimic, 'joint', f'<mimic> of {where}'),
        number(mimic, 'multiplier', where, 1.0),
        number(mimic, 'offset', where, 0.0),
    )


def read_mass(link: XmlElement, where: str) -> float | None:
    """
    Parse the mass of a link.

    Parameters
    ----------
    link
        The `<link>` element.
    where
        Description of the link, for error messages: "link 'pelvis'".

    Returns
    -------
    float | None
        The mass in kg; None without an `<inertial>` that has one.

    Raises
    ------
    UrdfError
        The mass is not a number.

    """
    inertial = link.find('inertial')
    mass = None if inertial is None else inertial.find('mass')
    return None if mass is None else number(mass, 'value', f'<mass> of {where}', 0.0)


def read_materials(robot: XmlElement) -> dict[str, Color]:
    """
    Collect the colours of all named materials of the robot and its links.

    Parameters
    ----------
    robot
        The `<robot>` element.

    Returns
    -------
    dict[str, Color]
        The colours by material name; those of the robot take precedence over those of links.

    Raises
    ------
    UrdfError
        The `rgba` of a colour is missing or invalid.

    """
    links = [visual for link in robot.find_all('link') for visual in link.find_all('visual')]
    materials = [each for place in (*links, robot) for each in place.find_all('material')]
    colors = {each.attributes.get('name', ''): _color(each) for each in materials}
    return {name: color for name, color in colors.items() if name and color}


def read_shapes(
    link: XmlElement, tag: str, where: str, materials: Mapping[str, Color]
) -> tuple[Shape, ...]:
    """
    Parse the `<visual>` or `<collision>` elements of a link.

    Parameters
    ----------
    link
        The `<link>` element.
    tag
        'visual' or 'collision'.
    where
        Description of the link, for error messages: "link 'pelvis'".
    materials
        The colours from `read_materials`.

    Raises
    ------
    UrdfError
        A geometry or colour is missing or invalid.

    """
    return tuple(_shape(each, f'<{tag}> of {where}', materials) for each in link.find_all(tag))


def _shape(element: XmlElement, where: str, materials: Mapping[str, Color]) -> Shape:
    material = element.find('material')
    color = None
    if material is not None:
        color = _color(material) or materials.get(material.attributes.get('name', ''))
    return Shape(_geometry(element, where), origin_of(element, where), color)


def _color(material: XmlElement) -> Color | None:
    """Parse the colour of a material, if it has one itself."""
    element = material.find('color')
    if element is None:
        return None
    where = f"material '{material.attributes.get('name', '')}'"
    given = text(element, 'rgba', f'<color> of {where}')
    try:
        red, green, blue, opacity = (min(max(float(word), 0.0), 1.0) for word in given.split())
    except ValueError:
        raise UrdfError(
            f"'rgba' in <color> of {where} is '{given}', but must be four numbers from 0 to 1 "
            'separated by spaces.',
            element.line,
        ) from None
    return red, green, blue, opacity


def _geometry(element: XmlElement, where: str) -> Geometry:
    holder = child(element, 'geometry', where)
    if not holder.children:
        raise UrdfError(f'<geometry> in {where} is empty. {_kinds()}', holder.line)
    body = holder.children[0]
    read = READERS.get(body.tag)
    if read is None:
        raise UrdfError(
            f'<{body.tag}> in {where} is not a geometry. {_kinds()} '
            f'{did_you_mean(body.tag, READERS, 0.75)}'.rstrip(),
            body.line,
        )
    return read(body, where)


def _kinds() -> str:
    return f'There are {", ".join(f"<{tag}>" for tag in READERS)}.'


def _box(body: XmlElement, where: str) -> Box:
    text(body, 'size', f'<box> of {where}')
    size = vector(body, 'size', where, (0.0, 0.0, 0.0))
    if min(size) < 0.0:
        raise _negative(body, 'size', where)
    return Box(size)


def _cylinder(body: XmlElement, where: str) -> Cylinder:
    return Cylinder(_length(body, 'radius', where), _length(body, 'length', where))


def _capsule(body: XmlElement, where: str) -> Capsule:
    return Capsule(_length(body, 'radius', where), _length(body, 'length', where))


def _sphere(body: XmlElement, where: str) -> Sphere:
    return Sphere(_length(body, 'radius', where))


def _mesh(body: XmlElement, where: str) -> Mesh:
    file = text(body, 'filename', f'<mesh> of {where}')
    return Mesh(file, vector(body, 'scale', where, (1.0, 1.0, 1.0)))


def _length(body: XmlElement, name: str, where: str) -> float:
    text(body, name, f'<{body.tag}> of {where}')
    length = number(body, name, where, 0.0)
    if length < 0.0:
        raise _negative(body, name, where)
    return length


def _negative(body: XmlElement, name: str, where: str) -> UrdfError:
    given = body.attributes[name]
    return UrdfError(f"'{name}' in <{body.tag}> of {where} is negative: {given}.", body.line)


READERS: dict[str, Callable[[XmlElement, str], Geometry]] = {
    'box': _box,
    'capsule': _capsule,
    'cylinder': _cylinder,
    'mesh': _mesh,
    'sphere': _sphere,
}
