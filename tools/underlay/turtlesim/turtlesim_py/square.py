# SPDX-License-Identifier: Apache-2.0
"""How a turtle goes round a square."""

from __future__ import annotations

import math

from turtlesim_py.canvas import Point
from turtlesim_py.turtle import Velocity, wrapped
from turtlesim_py.world import CENTRE

__all__ = ['Square']

SIDE = 2.0
SPEED, TURN_RATE = 1.0, 1.0
GAIN = 4.0
"""How much slower a turtle gets close to a goal, in 1/s."""
NEAR, NEAR_RAD = 0.01, 0.003


class Square:
    """
    The way round a square, counterclockwise, from the middle of the field.

    Attributes
    ----------
    corner, heading
        The corner to which the turtle goes, and the direction in rad in which it goes there.

    """

    def __init__(self) -> None:
        self.corner: Point = (CENTRE + SIDE, CENTRE)
        self.heading = 0.0

    def velocity_at(self, x: float, y: float, theta: float) -> Velocity:
        """
        Return how to move; once at its corner, go on to the next one.

        Parameters
        ----------
        x, y, theta
            Where the turtle is, and its heading.

        """
        left = wrapped(self.heading - theta)
        if abs(left) > NEAR_RAD:
            return Velocity(turn=math.copysign(min(TURN_RATE, GAIN * abs(left)), left))
        along = math.cos(self.heading), math.sin(self.heading)
        way = (self.corner[0] - x) * along[0] + (self.corner[1] - y) * along[1]
        if way > NEAR:
            return Velocity(forward=min(SPEED, GAIN * way))
        self.heading = wrapped(self.heading + math.pi / 2.0)
        self.corner = (
            self.corner[0] + SIDE * math.cos(self.heading),
            self.corner[1] + SIDE * math.sin(self.heading),
        )
        return Velocity()
