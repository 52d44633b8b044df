# SPDX-License-Identifier: Apache-2.0
"""Robot model of a URDF."""

from __future__ import annotations

from dataclasses import dataclass, field

from urdf.joint import Joint, Mimic
from urdf.shape import Shape

__all__ = ['Link', 'RobotModel']


@dataclass(frozen=True)
class Link:
    """A link with its visuals and collisions, and the line that defines it."""

    name: str
    visuals: tuple[Shape, ...] = ()
    collisions: tuple[Shape, ...] = ()
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
