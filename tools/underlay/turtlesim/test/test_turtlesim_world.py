# SPDX-License-Identifier: Apache-2.0
"""Turtles in their field, with time that a test lets pass."""

from __future__ import annotations

import math

import pytest
from turtlesim_py.canvas import FIELD, Pen
from turtlesim_py.turtle import Turtle, Velocity
from turtlesim_py.world import CENTRE, TurtleError, World

RED = (255, 0, 0)


@pytest.fixture
def world() -> World:
    """Return a field whose only turtle is in the middle, at the time 0."""
    world = World(0.0)
    world.reset()
    return world


@pytest.fixture
def turtle(world: World) -> Turtle:
    """Return that turtle."""
    return world.turtles['turtle1']


def pass_time(world: World, start_s: float, end_s: float, rate_hz: float = 62.5) -> None:
    """Let time pass, in the steps of a timer."""
    count = round((end_s - start_s) * rate_hz)
    for index in range(1, count + 1):
        world.advance(start_s + (end_s - start_s) * index / count)


def test_begin(turtle: Turtle) -> None:
    """The first turtle looks to the right from the middle of the field."""
    assert (turtle.x, turtle.y, turtle.theta) == pytest.approx((5.544445, 5.544445, 0.0))
    assert turtle.under == (69, 86, 255)


@pytest.mark.parametrize('rate_hz', [62.5, 7.0, 0.5])
def test_a_command_lasts_a_second(world: World, turtle: Turtle, rate_hz: float) -> None:
    """A turtle goes as far as its velocity, however seldom time passes; then it rests."""
    world.command('turtle1', Velocity(forward=2.0), 0.005)
    pass_time(world, 0.005, 4.0, rate_hz)
    assert turtle.x == pytest.approx(CENTRE + 2.0)
    assert turtle.velocity == Velocity()


def test_commands_follow_each_other(world: World, turtle: Turtle) -> None:
    """A command ends the one before at once; the velocity is told while it moves."""
    world.command('turtle1', Velocity(forward=1.0), 0.0)
    world.command('turtle1', Velocity(forward=-3.0), 0.5)
    assert turtle.velocity.linear == -3.0
    world.command('turtle1', Velocity(), 0.75)
    pass_time(world, 0.75, 3.0)
    assert turtle.x == pytest.approx(CENTRE + 0.5 - 0.75)


@pytest.mark.parametrize('rate_hz', [62.5, 5.0])
def test_curve(world: World, turtle: Turtle, rate_hz: float) -> None:
    """A turtle that turns goes round a circle: a quarter of one in a second."""
    world.command('turtle1', Velocity(forward=math.pi / 2, turn=math.pi / 2), 0.0)
    pass_time(world, 0.0, 1.2, rate_hz)
    assert (turtle.x, turtle.y) == pytest.approx((CENTRE + 1.0, CENTRE + 1.0), abs=1e-3)
    assert turtle.theta == pytest.approx(math.pi / 2)


@pytest.mark.parametrize(('is_holonomic', 'left'), [(False, 0.0), (True, 0.8)])
def test_sideways(world: World, turtle: Turtle, is_holonomic: bool, left: float) -> None:
    """Only holonomic turtles go sideways."""
    world.is_holonomic = is_holonomic
    world.command('turtle1', Velocity(forward=0.6, left=0.8), 0.0)
    assert turtle.velocity.linear == pytest.approx(1.0 if is_holonomic else 0.6)
    pass_time(world, 0.0, 1.0)
    assert (turtle.x - CENTRE, turtle.y - CENTRE) == pytest.approx((0.6, left))


def test_walls(world: World, turtle: Turtle) -> None:
    """A turtle stops at a wall, and where it would have gone is told once for each look."""
    world.command('turtle1', Velocity(forward=1000.0), 0.0)
    world.advance(0.016)
    assert (turtle.x, turtle.y) == (FIELD, CENTRE)
    ((x, y),) = world.take_hits()
    assert (x, y) == pytest.approx((CENTRE + 16.0, CENTRE))
    assert world.take_hits() == []
    world.advance(0.032)
    assert len(world.take_hits()) == 1
    world.teleport(turtle, -3.0, 20.0, 0.0)
    assert (turtle.x, turtle.y) == (0.0, FIELD)
    assert world.spawn(99.0, 1.0, 0.0).x == FIELD


def test_trail(world: World, turtle: Turtle) -> None:
    """A turtle draws where it goes, unless its pen is off, and senses what was drawn before."""
    turtle.pen = Pen(RED, 5)
    world.command('turtle1', Velocity(forward=2.0), 0.0)
    pass_time(world, 0.0, 1.0)
    turtle.pen = Pen(RED, 5, is_off=True)
    world.teleport(turtle, CENTRE + 1.0, 1.0, 0.0)
    assert turtle.under == world.background
    world.teleport(turtle, CENTRE + 1.0, CENTRE, 0.0)
    assert turtle.under == RED
    world.teleport(turtle, CENTRE + 1.0, CENTRE + 0.2, 0.0)
    assert turtle.under == world.background
    world.background = (1, 2, 3)
    world.advance(1.1)
    assert turtle.under == (1, 2, 3)


def test_teleport(world: World, turtle: Turtle) -> None:
    """It may be to a place, or forward after a turn; the pen draws a line."""
    world.teleport(turtle, 2.0, 3.0, 1.5 * math.pi)
    assert (turtle.x, turtle.y, turtle.theta) == pytest.approx((2.0, 3.0, -math.pi / 2))
    middle = (2.0 + CENTRE) / 2, (3.0 + CENTRE) / 2
    assert world.canvas.colour_at(middle, world.background) == turtle.pen.colour
    world.teleport_by(turtle, 1.0, math.pi)
    assert (turtle.x, turtle.y, turtle.theta) == pytest.approx((2.0, 4.0, math.pi / 2))


@pytest.mark.parametrize(
    ('start', 'goal', 'way'),
    [(0.0, 1.57, 1.57), (3.0, -3.0, math.tau - 6.0), (1.0, 7.0, 6.0 - math.tau)],
)
def test_rotation(world: World, turtle: Turtle, start: float, goal: float, way: float) -> None:
    """A turtle turns the shorter way at 1 rad/s, and stops exactly at its goal."""
    turtle.theta = start
    world.command('turtle1', Velocity(forward=1.0), 0.0)
    turtle.turn_to(goal)
    assert turtle.remaining == pytest.approx(way)
    pass_time(world, 0.0, abs(way) / 2)
    assert turtle.remaining == pytest.approx(way / 2)
    assert turtle.velocity == Velocity(turn=math.copysign(1.0, way))
    world.command('turtle1', Velocity(forward=1.0), abs(way) / 2)
    pass_time(world, abs(way) / 2, abs(way) + 0.1)
    assert (turtle.goal, turtle.velocity, turtle.x) == (None, Velocity(), CENTRE)
    assert math.remainder(turtle.theta - goal, math.tau) == pytest.approx(0.0, abs=1e-12)


def test_names(world: World) -> None:
    """Turtles get the next free name, or the one that they are given."""
    world.spawn(1.0, 1.0, 0.0, 'turtle2')
    assert world.spawn(2.0, 1.0, 0.0).name == 'turtle3'
    world.kill('turtle3')
    assert world.spawn(2.0, 1.0, 0.0).name == 'turtle4'
    with pytest.raises(TurtleError, match=r'A turtle named \[turtle2\] already exists'):
        world.spawn(1.0, 1.0, 0.0, 'turtle2')
    with pytest.raises(TurtleError, match=r'\[turtle3\], which does not exist'):
        world.kill('turtle3')
    with pytest.raises(TurtleError, match=r'There is no turtle \[turtle3\]'):
        world.command('turtle3', Velocity(), 0.0)
    assert list(world.turtles) == ['turtle1', 'turtle2', 'turtle4']
    assert len({turtle.number for turtle in world.turtles.values()}) == 3


def test_reset(world: World, turtle: Turtle) -> None:
    """Only a new first turtle is left, and nothing that was drawn."""
    world.spawn(1.0, 1.0, 0.0)
    world.teleport(turtle, 1.0, 1.0, 1.0)
    first = world.reset()
    assert list(world.turtles.values()) == [first]
    assert (first.name, first.x, first.theta) == ('turtle1', CENTRE, 0.0)
    assert world.canvas.is_blank
    assert world.spawn(1.0, 1.0, 0.0).name == 'turtle2'


@pytest.mark.parametrize('number', [math.nan, math.inf])
def test_numbers_that_are_none(world: World, turtle: Turtle, number: float) -> None:
    """What is not finite is refused, and nothing has changed."""
    for work in (
        lambda: world.command('turtle1', Velocity(turn=number), 0.0),
        lambda: world.teleport(turtle, number, 0.0, 0.0),
        lambda: world.teleport_by(turtle, 0.0, number),
        lambda: world.spawn(0.0, number, 0.0),
    ):
        with pytest.raises(TurtleError, match='finite'):
            work()
    assert (turtle.place, turtle.until_s, len(world.turtles)) == ((CENTRE, CENTRE), -math.inf, 1)
