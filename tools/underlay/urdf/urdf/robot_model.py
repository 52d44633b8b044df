# SPDX-License-Identifier: Apache-2.0
"""What a URDF says about a robot."""

from __future__ import annotations

from dataclasses import dataclass, field

from urdf.joint import Joint, Mimic
from urdf.shape import Shape

__all__ = ['Link', 'RobotModel']


@dataclass(frozen=True)
class Link:
    """A link with its bodies, and the line that defines it."""

    name: str
    visuals: tuple[Shape, ...] = ()
    collisions: tuple[Shape, ...] = ()
    line: int | None = field(default=None, compare=False)


@dataclass(frozen=True)
class RobotModel:
    """A robot: its links and joints in the order of the URDF, which form one tree."""

    name: str
    links: tuple[Link, ...]
    joints: tuple[Joint, ...]

    @property
    def root(self) -> str:
        """Return the link that is nobody's child."""
        children = {joint.child for joint in self.joints}
        return next(link.name for link in self.links if link.name not in children)

    @property
    def moving_joints(self) -> tuple[Joint, ...]:
        """Return the joints whose position is one number."""
        return tuple(joint for joint in self.joints if joint.moves)

    @property
    def mimics(self) -> dict[str, Mimic]:
        """Return which joints follow others, by name."""
        return {joint.name: joint.mimic for joint in self.moving_joints if joint.mimic}

    def describe(self) -> str:
        """Return the robot in words."""
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
    """Return a number with its noun."""
    return f'{number} {noun}' + ('' if number == 1 else 's')
