# SPDX-License-Identifier: Apache-2.0
"""The parameters of the examples."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_common.parameters import parameter, ParameterError
from humanoid_simulation.examples.push_series import PushPlan
from humanoid_simulation.examples.square_drive import SquarePlan


@dataclass(frozen=True)
class WalkSquareParameters:
    """Parameters of `walk_square`: size of the square, and speeds."""

    side_m: float = parameter(
        1.0, 'Length of a side.', at_least=0.2, at_most=100.0, read_only=True
    )
    speed_m_s: float = parameter(
        0.2, 'Speed along the sides.', at_least=0.05, at_most=0.5, read_only=True
    )
    turn_rad_s: float = parameter(
        0.4, 'Speed of the turns.', at_least=0.1, at_most=1.0, read_only=True
    )

    @property
    def plan(self) -> SquarePlan:
        """Return the plan that the parameters describe."""
        return SquarePlan(self.side_m, self.speed_m_s, self.turn_rad_s)


@dataclass(frozen=True)
class PushTestParameters:
    """Parameters of `push_test`: impulses and duration of the pushes."""

    first_ns: float = parameter(
        5.0, 'The gentlest impulse, in N s.', at_least=0.1, at_most=1000.0, read_only=True
    )
    step_ns: float = parameter(
        5.0,
        'How much harder the next one is, in N s.',
        at_least=0.1,
        at_most=1000.0,
        read_only=True,
    )
    most_ns: float = parameter(
        30.0, 'The hardest impulse, in N s.', at_least=0.1, at_most=1000.0, read_only=True
    )
    duration_s: float = parameter(
        0.1, 'How long a push lasts.', at_least=0.002, at_most=0.9, read_only=True
    )
    simulator: str = parameter(
        '/simulator', 'The full name of the simulator, whose services are used.', read_only=True
    )

    def __post_init__(self) -> None:
        """Check that the range of impulses is not empty."""
        if self.first_ns > self.most_ns:
            raise ParameterError(
                f"Parameter 'first_ns' is {self.first_ns:g}, but must not be more than "
                f"'most_ns', which is {self.most_ns:g}.",
                'first_ns',
                'most_ns',
            )

    @property
    def plan(self) -> PushPlan:
        """Return the plan that the parameters describe."""
        return PushPlan(self.first_ns, self.step_ns, self.most_ns)
