# SPDX-License-Identifier: Apache-2.0
"""Parse the joints of a URDF."""

from __future__ import annotations

import math

from urdf.attributes import child, number, origin_of, text, vector
from urdf.did_you_mean import did_you_mean
from urdf.joint import Joint, KINDS, LIMITED, Limits, Mimic, MOVING, Vector
from urdf.urdf_error import UrdfError
from urdf.xml_element import XmlElement

__all__ = ['read_joint']


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
            f"The type of {where} is '{kind}', but must be one of {', '.join(KINDS)}."
            f'{did_you_mean(kind, KINDS)}',
            element.line,
        )
    return kind


def _axis(element: XmlElement, where: str) -> Vector:
    """Parse and normalize the axis; the default is x."""
    axis = element.find('axis')
    x, y, z = vector(axis, 'xyz', where, Joint.axis)
    length = math.hypot(x, y, z)
    if axis is not None and length == 0.0:
        raise UrdfError(f'The axis of {where} is zero, so that it has no direction.', axis.line)
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
