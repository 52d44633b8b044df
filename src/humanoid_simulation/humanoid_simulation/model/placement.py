# SPDX-License-Identifier: Apache-2.0
"""Initial placement of robots."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math

from humanoid_simulation.errors import SimulationError


@dataclass(frozen=True)
class Placement:
    """A robot's name, which is its namespace, and its initial pose on the ground."""

    robot: str = ''
    x_m: float = 0.0
    y_m: float = 0.0
    z_m: float = 0.0
    """The height of the ground there."""
    yaw_rad: float = 0.0


def check_placements(placements: Sequence[Placement]) -> None:
    """
    Check that robots have unique names and finite positions.

    Parameters
    ----------
    placements
        One for each robot.

    Raises
    ------
    SimulationError
        There is no robot, a name is duplicated or missing, or a position is not finite.

    """
    if not placements:
        raise SimulationError('There is no robot to simulate. Name one at least.')
    names = [placement.robot for placement in placements]
    for name in names:
        if names.count(name) > 1:
            raise SimulationError(f"Two robots are called '{name}'. Give each a name of its own.")
        if name == '' and len(names) > 1:
            raise SimulationError('A robot among several needs a name, which is its namespace.')
    for place in placements:
        if not all(map(math.isfinite, (place.x_m, place.y_m, place.z_m, place.yaw_rad))):
            raise SimulationError(f"The place of robot '{place.robot}' is not finite: {place}.")
