# SPDX-License-Identifier: Apache-2.0
"""Joints, with what limits and couples them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from urdf_parser_py.reading import add, Element, number, numbers, text
from urdf_parser_py.shapes import Pose, read_origin, write_origin

__all__ = [
    'Joint',
    'JointCalibration',
    'JointDynamics',
    'JointLimit',
    'JointMimic',
    'SafetyController',
]


@dataclass
class JointLimit:
    """What a joint can do: torque or force, velocity and positions (N m, rad; N, m; s)."""

    effort: float
    velocity: float
    lower: float = 0.0
    upper: float = 0.0


@dataclass
class JointDynamics:
    """Damping (N m s/rad or N s/m) and friction (N m or N) of a joint."""

    damping: float = 0.0
    friction: float = 0.0


@dataclass
class JointMimic:
    """The joint that another one follows: multiplier times its position, plus offset."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass
class JointCalibration:
    """Positions at which a switch of the joint rises or falls."""

    rising: float | None = None
    falling: float | None = None


@dataclass
class SafetyController:
    """Soft limits of a joint, and their stiffness."""

    k_velocity: float
    k_position: float = 0.0
    soft_lower_limit: float = 0.0
    soft_upper_limit: float = 0.0


@dataclass
class Joint:
    """A joint between two links, which are given by name."""

    TYPES: ClassVar = [
        'unknown',
        'revolute',
        'continuous',
        'prismatic',
        'floating',
        'planar',
        'fixed',
    ]

    name: str | None = None
    parent: str | None = None
    child: str | None = None
    joint_type: str = 'fixed'
    axis: list[float] | None = None
    origin: Pose | None = None
    limit: JointLimit | None = None
    dynamics: JointDynamics | None = None
    safety_controller: SafetyController | None = None
    calibration: JointCalibration | None = None
    mimic: JointMimic | None = None

    def _type(self) -> str:
        return self.joint_type

    def _set_type(self, value: str) -> None:
        self.joint_type = value

    type = property(_type, _set_type, doc="The kind of the joint, such as 'revolute'.")

    @classmethod
    def from_xml(cls, element: Any) -> Joint:
        """
        Read a joint.

        Parameters
        ----------
        element
            The element `joint`.

        Raises
        ------
        ValueError
            Something is missing or wrong.

        """
        joint = cls(text(element, 'name'), joint_type=text(element, 'type'))
        if joint.joint_type not in cls.TYPES:
            raise ValueError(
                f'The type of joint {joint.name!r} is {joint.joint_type!r}, but must be one of '
                f'{", ".join(cls.TYPES[1:])}'
            )
        joint.parent = _link(element, 'parent')
        joint.child = _link(element, 'child')
        axis = element.find('axis')
        joint.axis = None if axis is None else numbers(axis, 'xyz')
        joint.origin = read_origin(element)
        _read_properties(joint, element)
        return joint

    def to_xml(self, parent: Element) -> None:
        """
        Write the joint.

        Parameters
        ----------
        parent
            The element that gets it.

        """
        element = add(parent, 'joint', name=self.name, type=self.joint_type)
        write_origin(element, self.origin)
        add(element, 'parent', link=self.parent)
        add(element, 'child', link=self.child)
        if self.axis is not None:
            add(element, 'axis', xyz=self.axis)
        for tag in ('calibration', 'dynamics', 'limit', 'mimic', 'safety_controller'):
            if getattr(self, tag) is not None:
                add(element, tag, **vars(getattr(self, tag)))


def _link(element: Any, tag: str) -> str:
    found = element.find(tag)
    if found is None:
        raise ValueError(f'The joint {element.get("name")!r} has no <{tag}>')
    return text(found, 'link')


def _read_properties(joint: Joint, element: Any) -> None:
    limit, dynamics = element.find('limit'), element.find('dynamics')
    if limit is not None:
        joint.limit = JointLimit(
            number(limit, 'effort'),
            number(limit, 'velocity'),
            number(limit, 'lower', 0.0),
            number(limit, 'upper', 0.0),
        )
    if dynamics is not None:
        joint.dynamics = JointDynamics(
            number(dynamics, 'damping', 0.0), number(dynamics, 'friction', 0.0)
        )
    mimic, safety = element.find('mimic'), element.find('safety_controller')
    if mimic is not None:
        joint.mimic = JointMimic(
            text(mimic, 'joint'), number(mimic, 'multiplier', 1.0), number(mimic, 'offset', 0.0)
        )
    if safety is not None:
        joint.safety_controller = SafetyController(
            number(safety, 'k_velocity'),
            *(
                number(safety, name, 0.0)
                for name in ('k_position', 'soft_lower_limit', 'soft_upper_limit')
            ),
        )
    calibration = element.find('calibration')
    if calibration is not None:
        joint.calibration = JointCalibration(
            *(
                None if calibration.get(name) is None else number(calibration, name)
                for name in ('rising', 'falling')
            )
        )
