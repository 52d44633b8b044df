# SPDX-License-Identifier: Apache-2.0
"""The turtles in their field: how they move, draw, hit walls, come and go."""

from __future__ import annotations

from dataclasses import replace
import math

from turtlesim_py.canvas import Canvas, Colour, FIELD, Point
from turtlesim_py.turtle import REST, Turtle, Velocity, wrapped

__all__ = ['CENTRE', 'FIRST', 'TurtleError', 'World']

CENTRE = FIELD / 2.0
FIRST = 'turtle1'
COMMAND_S = 1.0
"""How long a turtle moves after a command."""
STEP_S = 0.016


class TurtleError(ValueError):
    """What was asked for is not possible, with the reason."""


class World:
    """
    The field with its turtles; time passes when `advance` is called.

    Parameters
    ----------
    now_s
        The time, of any clock.

    Attributes
    ----------
    turtles
        The turtles by name.
    canvas
        What they have drawn.
    background
        The colour of the field.
    is_holonomic
        Whether they follow the sideways part of a command.

    """

    def __init__(self, now_s: float) -> None:
        self.turtles: dict[str, Turtle] = {}
        self.canvas = Canvas()
        self.background: Colour = (69, 86, 255)
        self.is_holonomic = False
        self._now_s = now_s
        self._count = self._names = 0
        self._hits: dict[str, Point] = {}

    def advance(self, now_s: float) -> None:
        """
        Move the turtles.

        Parameters
        ----------
        now_s
            The time.

        """
        for turtle in self.turtles.values():
            if turtle.goal is not None:
                turtle.rotate(now_s - self._now_s)
            elif turtle.until_s > self._now_s:
                self._drive(turtle, min(turtle.until_s, now_s) - self._now_s)
            else:
                turtle.velocity = REST
                turtle.under = self._colour_under(turtle)
        self._now_s = now_s

    def command(self, name: str, velocity: Velocity, now_s: float) -> None:
        """
        Let a turtle move for a second; one that turns to a heading does not obey.

        Parameters
        ----------
        name, velocity
            The turtle, and how it is to move.
        now_s
            The time.

        Raises
        ------
        TurtleError
            There is no such turtle, or the velocity is not finite.

        """
        _check_finite(velocity.forward, velocity.left, velocity.turn)
        if name not in self.turtles:
            raise TurtleError(f'There is no turtle [{name}]')
        self.advance(now_s)
        turtle = self.turtles[name]
        if turtle.goal is None:
            turtle.velocity = velocity if self.is_holonomic else replace(velocity, left=0.0)
            turtle.until_s = now_s + COMMAND_S

    def teleport(self, turtle: Turtle, x: float, y: float, theta: float) -> None:
        """
        Put a turtle elsewhere; its pen draws a line to there.

        Parameters
        ----------
        turtle
            The turtle.
        x, y, theta
            Where it is to be, and its heading; places outside of the field are at its edge.

        Raises
        ------
        TurtleError
            A number is not finite.

        """
        _check_finite(x, y, theta)
        turtle.theta = wrapped(theta)
        self._move(turtle, x, y)

    def teleport_by(self, turtle: Turtle, linear: float, angular: float) -> None:
        """
        Turn a turtle, then put it forward; its pen draws a line.

        Parameters
        ----------
        turtle
            The turtle.
        linear, angular
            How far forward, and by which angle in rad.

        Raises
        ------
        TurtleError
            A number is not finite.

        """
        theta = turtle.theta + angular
        _check_finite(linear, angular)
        self.teleport(
            turtle,
            turtle.x + linear * math.cos(theta),
            turtle.y + linear * math.sin(theta),
            theta,
        )

    def spawn(self, x: float, y: float, theta: float, name: str = '') -> Turtle:
        """
        Add a turtle.

        Parameters
        ----------
        x, y, theta
            Where it is, and its heading; places outside of the field are at its edge.
        name
            Its name; the next of `turtle1`, `turtle2` ... if empty.

        Returns
        -------
        Turtle
            The new turtle.

        Raises
        ------
        TurtleError
            There is already one of that name, or a number is not finite.

        """
        _check_finite(x, y, theta)
        if name in self.turtles:
            raise TurtleError(f'A turtle named [{name}] already exists')
        self._count += 1
        while not name or name in self.turtles:
            self._names += 1
            name = f'turtle{self._names}'
        turtle = Turtle(name, self._count, x, y, wrapped(theta), self.background)
        self.turtles[name] = turtle
        self._keep_inside(turtle, x, y)
        turtle.under = self._colour_under(turtle)
        return turtle

    def kill(self, name: str) -> None:
        """
        Remove a turtle; what it has drawn stays.

        Parameters
        ----------
        name
            The name of the turtle.

        Raises
        ------
        TurtleError
            There is no such turtle.

        """
        if self.turtles.pop(name, None) is None:
            raise TurtleError(f'Tried to kill turtle [{name}], which does not exist')
        self._hits.pop(name, None)

    def reset(self) -> Turtle:
        """Erase everything, and leave one new turtle in the middle; return it."""
        self.turtles.clear()
        self.canvas.clear()
        self._hits.clear()
        self._count = self._names = 0
        return self.spawn(CENTRE, CENTRE, 0.0)

    def take_hits(self) -> list[Point]:
        """Return where turtles would have gone without walls, since the last call."""
        hits, self._hits = list(self._hits.values()), {}
        return hits

    def _drive(self, turtle: Turtle, time_s: float) -> None:
        """Move a turtle at its velocity, in steps that are short enough for its curve."""
        velocity = turtle.velocity
        steps = max(1, math.ceil(time_s / STEP_S))
        step_s = time_s / steps
        forward, left = velocity.forward * step_s, velocity.left * step_s
        for _ in range(steps):
            heading = turtle.theta + velocity.turn * step_s / 2.0
            turtle.theta = wrapped(turtle.theta + velocity.turn * step_s)
            x = turtle.x + forward * math.cos(heading) - left * math.sin(heading)
            y = turtle.y + forward * math.sin(heading) + left * math.cos(heading)
            self._move(turtle, x, y)

    def _move(self, turtle: Turtle, x: float, y: float) -> None:
        """Put a turtle elsewhere, which draws a line."""
        before = turtle.place
        self._keep_inside(turtle, x, y)
        turtle.under = self._colour_under(turtle)
        if turtle.place != before and not turtle.pen.is_off:
            self.canvas.draw(turtle.number, turtle.pen, before, turtle.place)

    def _keep_inside(self, turtle: Turtle, x: float, y: float) -> None:
        turtle.x, turtle.y = min(max(x, 0.0), FIELD), min(max(y, 0.0), FIELD)
        if turtle.place != (x, y):
            self._hits[turtle.name] = (x, y)

    def _colour_under(self, turtle: Turtle) -> Colour:
        return self.canvas.colour_at(turtle.place, self.background)


def _check_finite(*numbers: float) -> None:
    if not all(map(math.isfinite, numbers)):
        raise TurtleError(f'Not all of these numbers are finite: {list(numbers)}')
