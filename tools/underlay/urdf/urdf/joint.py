# SPDX-License-Identifier: Apache-2.0
"""Joints of a robot model."""

from __future__ import annotations

from dataclasses import dataclass, field

__all__ = ['KINDS', 'LIMITED', 'MOVING', 'Joint', 'Limits', 'Mimic', 'Origin', 'Vector']

Vector = tuple[float, float, float]
LIMITED = ('revolute', 'prismatic')
MOVING = (*LIMITED, 'continuous')
"""The joint types with a scalar position (one degree of freedom)."""
KINDS = (*MOVING, 'fixed', 'floating', 'planar')


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
