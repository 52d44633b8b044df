# SPDX-License-Identifier: Apache-2.0
"""Speed limits of a robot."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import Any, NamedTuple

__all__ = ['STILL', 'SpeedLimits', 'Velocity']


class Velocity(NamedTuple):
    """Velocity of the base of a robot."""

    forward_m_s: float = 0.0
    left_m_s: float = 0.0
    turn_rad_s: float = 0.0


STILL = Velocity()


@dataclass(frozen=True)
class SpeedLimits:
    """Maximum speeds; zero for directions in which the robot cannot move."""

    forward_m_s: float
    sideways_m_s: float
    turn_rad_s: float

    def velocity(self, stick: Any, share: Any) -> Velocity:
        """
        Scale the deflection of the stick to a velocity of the base.

        Numbers outside their range are clamped.

        Parameters
        ----------
        stick
            Three numbers from -1 to 1: forward, left, and turn to the left.
        share
            Two numbers from 0 to 1: the fractions of the linear and of the angular speed limits
            that the user has selected.

        Returns
        -------
        Velocity
            In m/s and rad/s, in the base frame.

        Raises
        ------
        ValueError
            An argument is not a list of the required number of finite numbers.

        """
        forward, left, turn = _numbers(stick, 3, -1.0)
        move_share, turn_share = _numbers(share, 2, 0.0)
        return Velocity(
            forward * move_share * self.forward_m_s,
            left * move_share * self.sideways_m_s,
            turn * turn_share * self.turn_rad_s,
        )


def _numbers(given: Any, count: int, least: float) -> list[float]:
    """Validate numbers and clamp them to the range, or raise ValueError."""
    if not isinstance(given, list) or len(given) != count:
        raise ValueError(f'must be {count} numbers, and not {given}')
    for each in given:
        is_number = isinstance(each, (int, float)) and not isinstance(each, bool)
        if not is_number or not -math.inf < each < math.inf:  # a large integer may not fit a float
            raise ValueError(f'must be finite numbers, and not {given}')
    return [float(max(least, min(1.0, each))) for each in given]
