# SPDX-License-Identifier: Apache-2.0
"""Robot model of a URDF: links with their shapes, joints, and chains of mimic joints."""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import dataclass, field
from typing import Union

__all__ = [
    'KINDS',
    'LIMITED',
    'MOVING',
    'Box',
    'Capsule',
    'Color',
    'Cylinder',
    'Geometry',
    'Joint',
    'Limits',
    'Link',
    'Mesh',
    'Mimic',
    'Origin',
    'RobotModel',
    'Shape',
    'Sphere',
    'Vector',
    'check_for_loops',
    'followed',
]

Vector = tuple[float, float, float]
LIMITED = ('revolute', 'prismatic')
MOVING = (*LIMITED, 'continuous')
"""The joint types with a scalar position (one degree of freedom)."""
KINDS = (*MOVING, 'fixed', 'floating', 'planar')

Color = tuple[float, float, float, float]
"""Red, green, blue and opacity, each from 0 to 1."""


@dataclass(frozen=True)
class Origin:
    """Pose in the frame of the (parent) link: xyz in metres; roll, pitch, yaw in radians."""

    xyz: Vector = (0.0, 0.0, 0.0)
    rpy: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Limits:
    """Position limits of a joint, in radians or metres."""

    lower: float
    upper: float


@dataclass(frozen=True)
class Mimic:
    """Mimic relation: the position is `multiplier` times that of another joint, plus `offset`."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True)
class Joint:
    """A joint between two links; the axis is a unit vector."""

    name: str
    kind: str
    parent: str
    child: str
    origin: Origin = Origin()
    axis: Vector = (1.0, 0.0, 0.0)
    limits: Limits | None = None
    soft_limits: Limits | None = None
    mimic: Mimic | None = None
    max_velocity: float | None = None
    """The velocity limit, in radians or metres per second; None if unlimited or unknown."""
    max_effort: float | None = None
    """The effort limit, in newton metres or newtons; None if unlimited or unknown."""
    line: int | None = field(default=None, compare=False)

    @property
    def moves(self) -> bool:
        """Whether the joint has a scalar position, as in joint states."""
        return self.kind in MOVING


@dataclass(frozen=True)
class Box:
    """A box, centred at its origin: lengths along x, y and z in metres."""

    size: Vector


@dataclass(frozen=True)
class Cylinder:
    """A cylinder along z, centred at its origin; in metres."""

    radius: float
    length: float


@dataclass(frozen=True)
class Capsule:
    """A capsule: a cylinder of `length` along z between two hemispheres; in metres."""

    radius: float
    length: float


@dataclass(frozen=True)
class Sphere:
    """A sphere, centred at its origin; in metres."""

    radius: float


@dataclass(frozen=True)
class Mesh:
    """A mesh: the file as in the URDF (`package://...`), and the scale along x, y and z."""

    file: str
    scale: Vector = (1.0, 1.0, 1.0)


Geometry = Union[Box, Capsule, Cylinder, Mesh, Sphere]


@dataclass(frozen=True)
class Shape:
    """Visual or collision shape of a link; without a colour, the viewer chooses one."""

    geometry: Geometry
    origin: Origin = field(default_factory=Origin)
    color: Color | None = None


@dataclass(frozen=True)
class Link:
    """A link with its visuals and collisions, and the line that defines it."""

    name: str
    visuals: tuple[Shape, ...] = ()
    collisions: tuple[Shape, ...] = ()
    mass: float | None = None
    """In kilograms; None if the URDF does not give one."""
    line: int | None = field(default=None, compare=False)


@dataclass(frozen=True)
class RobotModel:
    """Robot model: a tree of links and joints, in the order of the URDF."""

    name: str
    links: tuple[Link, ...]
    joints: tuple[Joint, ...]

    @property
    def root(self) -> str:
        """Return the name of the root link."""
        children = {joint.child for joint in self.joints}
        return next(link.name for link in self.links if link.name not in children)

    @property
    def moving_joints(self) -> tuple[Joint, ...]:
        """Return the joints with a scalar position."""
        return tuple(joint for joint in self.joints if joint.moves)

    @property
    def mimics(self) -> dict[str, Mimic]:
        """Return the mimic relations by joint name."""
        return {joint.name: joint.mimic for joint in self.moving_joints if joint.mimic}

    def describe(self) -> str:
        """Return a human-readable summary of the robot."""
        moving = len(self.moving_joints)
        counts = [
            f'{_count(len(self.links), "link")} below {self.root!r}',
            f'{_count(len(self.joints), "joint")}, {moving} of them moving',
        ]
        if self.mimics:
            verb = 'follows' if len(self.mimics) == 1 else 'follow'
            counts.append(f'{len(self.mimics)} of these {verb} others')
        return f'Robot {self.name!r}: {", ".join(counts)}.'


def _count(number: int, noun: str) -> str:
    """Format a number with a singular or plural noun."""
    return f'{number} {noun}' + ('' if number == 1 else 's')


def followed(name: str, mimics: Mapping[str, Mimic], known: Container[str]) -> Mimic | None:
    """
    Resolve a chain of mimic joints to the first joint in it whose position is known.

    Parameters
    ----------
    name
        The joint name; a known joint resolves to itself.
    mimics
        The mimic relations by joint name.
    known
        The joints whose positions are known.

    Returns
    -------
    Mimic or None
        The known joint with the multiplier and offset (rad or m) of the whole chain; None if no
        joint of the chain is known.

    """
    multiplier, offset = 1.0, 0.0
    while name not in known:
        mimic = mimics.get(name)
        if mimic is None:
            return None
        offset += multiplier * mimic.offset
        multiplier *= mimic.multiplier
        name = mimic.joint
    return Mimic(name, multiplier, offset)


def check_for_loops(mimics: Mapping[str, Mimic]) -> None:
    """
    Check that no mimic joints follow each other in a loop.

    Parameters
    ----------
    mimics
        The mimic relations by joint name.

    Raises
    ------
    ValueError
        There is a loop; the message contains the names of its joints, joined by ' -> '.

    """
    for name in mimics:
        chain = [name]
        while chain[-1] in mimics:
            chain.append(mimics[chain[-1]].joint)
            if chain[-1] == name:
                raise ValueError(' -> '.join(chain))
            if chain[-1] in chain[:-1]:
                break
