# SPDX-License-Identifier: Apache-2.0
"""A turtle: where it is, what it draws with, and what it is doing."""

from __future__ import annotations

from dataclasses import dataclass
import math

from turtlesim_py.canvas import Colour, Pen, Point

__all__ = ['REST', 'Turtle', 'Velocity', 'wrapped']

ROTATION_RATE = 1.0
"""The rate in rad/s at which a turtle turns to a heading."""


@dataclass(frozen=True)
class Velocity:
    """A velocity in the frame of a turtle, in units of length or rad per second."""

    forward: float = 0.0
    left: float = 0.0
    turn: float = 0.0

    @property
    def linear(self) -> float:
        """The forward velocity or, when it also moves sideways, the speed."""
        return math.hypot(self.forward, self.left) if self.left else self.forward


REST = Velocity()
PEN = Pen()


@dataclass
class Turtle:
    """
    A turtle.

    Attributes
    ----------
    name, number
        Its name, and which one it is of all that have come since the last reset.
    x, y, theta
        Where it is, and its heading in rad, counterclockwise from the direction of x.
    pen
        What it draws with.
    velocity
        The velocity at which it moves.
    until_s
        When the command that it follows ends.
    goal
        The heading that it turns to; None if it does not.
    under
        The colour that it has come to, before it drew there itself.

    """

    name: str
    number: int
    x: float
    y: float
    theta: float
    under: Colour
    pen: Pen = PEN
    velocity: Velocity = REST
    until_s: float = -math.inf
    goal: float | None = None

    @property
    def place(self) -> Point:
        """Where it is."""
        return self.x, self.y

    @property
    def remaining(self) -> float:
        """The rotation in rad that is left to its goal."""
        return 0.0 if self.goal is None else wrapped(self.goal - self.theta)

    def turn_to(self, heading: float) -> None:
        """
        Turn to a heading, instead of what it does.

        Parameters
        ----------
        heading
            The heading in rad.

        """
        self.stop()
        self.goal = heading

    def stop(self) -> None:
        """Stand still."""
        self.velocity, self.until_s, self.goal = REST, -math.inf, None

    def rotate(self, time_s: float) -> None:
        """
        Turn towards the goal, exactly to it in the end.

        Parameters
        ----------
        time_s
            The time that has passed.

        """
        remaining = self.remaining
        if abs(remaining) <= ROTATION_RATE * time_s:
            self.theta = wrapped(self.theta + remaining)
            self.stop()
        else:
            self.velocity = Velocity(turn=math.copysign(ROTATION_RATE, remaining))
            self.theta = wrapped(self.theta + self.velocity.turn * time_s)


def wrapped(angle: float) -> float:
    """
    Return an angle that is the same direction, from -pi to pi.

    Parameters
    ----------
    angle
        The angle in rad.

    """
    return math.remainder(angle, math.tau)
