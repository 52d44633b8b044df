# SPDX-License-Identifier: Apache-2.0
"""What a URDF says about a joint."""

from __future__ import annotations

from dataclasses import dataclass, field

__all__ = ['KINDS', 'LIMITED', 'MOVING', 'Joint', 'Limits', 'Mimic', 'Origin', 'Vector']

Vector = tuple[float, float, float]
LIMITED = ('revolute', 'prismatic')
MOVING = (*LIMITED, 'continuous')
"""The kinds of joints whose position is one number."""
KINDS = (*MOVING, 'fixed', 'floating', 'planar')


@dataclass(frozen=True)
class Origin:
    """Where a joint is in the frame of its parent link: metres; roll, pitch, yaw in radians."""

    xyz: Vector = (0.0, 0.0, 0.0)
    rpy: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Limits:
    """How far a joint goes, in radians or metres."""

    lower: float
    upper: float


@dataclass(frozen=True)
class Mimic:
    """A joint's position is `multiplier` times that of another joint, plus `offset`."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True)
class Joint:
    """A joint between two links; the axis has length 1."""

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
    """The speed that it may have, in radians or metres per second."""
    max_effort: float | None = None
    """The torque or force that it may have, in newton metres or newtons."""
    line: int | None = field(default=None, compare=False)

    @property
    def moves(self) -> bool:
        """Tell if its position is one number, which joint states give."""
        return self.kind in MOVING
