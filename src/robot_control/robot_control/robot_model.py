# SPDX-License-Identifier: Apache-2.0
"""What a URDF says about a robot."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Joint:
    """A joint; the limits are None where its type has none."""

    name: str
    kind: str
    parent: str
    child: str
    lower: float | None = None
    upper: float | None = None

    def describe(self) -> str:
        """Return the joint in words."""
        words = f'{self.name}: {self.kind}, {self.parent} -> {self.child}'
        if self.lower is None or self.upper is None:
            return words
        unit = 'm' if self.kind == 'prismatic' else 'rad'
        return f'{words}, {self.lower:g} to {self.upper:g} {unit}'


@dataclass(frozen=True)
class RobotModel:
    """A robot: its links and the joints between them."""

    name: str
    links: tuple[str, ...]
    joints: tuple[Joint, ...]

    def describe(self) -> list[str]:
        """Return the robot in words, one line for the whole and one for each joint."""
        summary = (
            f"Loaded robot '{self.name}': {len(self.links)} links "
            f'({", ".join(self.links)}), {len(self.joints)} joints'
        )
        return [summary, *(f'  {joint.describe()}' for joint in self.joints)]
