# SPDX-License-Identifier: Apache-2.0
"""Settings of the physics."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from humanoid_simulation.choosing import named
from humanoid_simulation.errors import SimulationError

SELF_COLLISIONS: Mapping[str, str] = {
    'none': 'the links of a robot pass through each other',
    'arms': 'arms collide with trunk, head, thighs and each other',
    'all': 'legs collide with each other as well',
}


@dataclass(frozen=True)
class Physics:
    """Time step, self-collisions, mass factors and sleeping of the physics."""

    period_s: float = 0.002
    self_collision: str = 'arms'
    mass_factors: Mapping[str, float] = field(default_factory=dict)
    """Factors by which the mass and inertia of links are multiplied, by link."""
    sleep: bool = True
    """
    Whether objects at rest sleep, together with their contacts, until something touches or moves
    them; that saves most of their cost. Robots never sleep.
    """

    def __post_init__(self) -> None:
        """Validate the settings."""
        named('kind of self-collision', self.self_collision, SELF_COLLISIONS)
        if not 1e-4 <= self.period_s <= 0.01:
            raise SimulationError(
                f'The physics cannot have a period of {self.period_s:g} s. '
                'Give one from 0.0001 to 0.01 s; 0.002 s is well tried.'
            )
        for link, factor in self.mass_factors.items():
            if not 0.01 <= factor <= 100.0:
                raise SimulationError(
                    f"The mass of link '{link}' cannot be multiplied by {factor:g}. "
                    'Give a factor from 0.01 to 100.'
                )
