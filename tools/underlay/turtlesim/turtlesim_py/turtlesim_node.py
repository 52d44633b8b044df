# SPDX-License-Identifier: Apache-2.0
"""The node turtlesim: the services and parameters of the field, and its turtles."""

from __future__ import annotations

import re
import time
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rcl_interfaces.msg import IntegerRange, ParameterDescriptor
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.parameter import Parameter
from rviz_common.inputs import WorkQueue
from rviz_common.page.address import declare_settings, PortError
from std_srvs.srv import Empty
from turtlesim.srv import Kill, Spawn
from turtlesim_py.turtle import Turtle
from turtlesim_py.turtle_interface import TurtleInterface
from turtlesim_py.turtle_page import TurtlePage
from turtlesim_py.world import TurtleError, World

__all__ = ['TurtlesimNode']

PERIOD_S = 0.016
TICKS_OF_FRAME = 2
"""The browser gets every second pose: 31 a second."""
WARNING_PERIOD_S = 0.5
NAME = re.compile(r'[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*')
LONGEST_NAME = 100
"""With the namespace; topics, whose names are longer than that of their turtle, may have 247."""
CHANNELS = {'red': 'background_r', 'green': 'background_g', 'blue': 'background_b'}


class TurtlesimNode(Node):
    """
    The field of turtles, with its page.

    Raises
    ------
    ValueError
        A parameter is invalid, or the port of the page is not available.
    rclpy.exceptions.ParameterException
        A parameter has a value of another type.

    Attributes
    ----------
    world
        The turtles.
    page
        The page that shows them.

    """

    def __init__(self) -> None:
        super().__init__('turtlesim')
        self.world = World(time.monotonic())
        self._declare_parameters()
        queue = WorkQueue()
        try:
            name = self.get_fully_qualified_name()
            self.page = TurtlePage(name, self.world, queue, declare_settings(self))
        except PortError as error:
            raise ValueError(str(error)) from error
        self._queue = queue
        self._interfaces: dict[str, TurtleInterface] = {}
        self._leaving: list[TurtleInterface] = []
        self._ticks = 0
        log = self.get_logger()
        log.info(f'Starting turtlesim with node name {name}')
        for kind, service, work in (
            (Empty, 'clear', self._clear),
            (Empty, 'reset', self._reset),
            (Kill, 'kill', self._kill),
            (Spawn, 'spawn', self._spawn),
        ):
            self.create_service(kind, service, work)
        self._welcome(self.world.reset())
        self.create_timer(PERIOD_S, self._tick, clock=Clock(clock_type=ClockType.STEADY_TIME))
        log.info(f'The turtles are at {" and ".join(self.page.urls)}')

    def destroy_node(self) -> None:
        """Close the page, and destroy the node."""
        self.page.close()
        super().destroy_node()

    def _declare_parameters(self) -> None:
        channel = IntegerRange(from_value=0, to_value=255, step=1)
        for (colour, name), default in zip(CHANNELS.items(), self.world.background):
            text = f'The {colour} part of the colour of the background.'
            descriptor = ParameterDescriptor(description=text, integer_range=[channel])
            self.declare_parameter(name, default, descriptor)
        text = 'Whether turtles follow the sideways part of cmd_vel, linear.y.'
        self.declare_parameter('holonomic', False, ParameterDescriptor(description=text))
        self._read_parameters([])
        self.add_post_set_parameters_callback(self._read_parameters)

    def _read_parameters(self, changed: list[Parameter]) -> None:
        red, green, blue = (self.get_parameter(name).value for name in CHANNELS.values())
        self.world.background = (red, green, blue)
        self.world.is_holonomic = self.get_parameter('holonomic').value

    def _tick(self) -> None:
        """Let time pass, and tell everybody."""
        self._queue.run()
        self.world.advance(time.monotonic())
        for place in self.world.take_hits():
            x, y = _in_single_precision(*place)
            self.get_logger().warning(
                f'Oh no! I hit the wall! (Clamping from [x={x:f}, y={y:f}])',
                throttle_duration_sec=WARNING_PERIOD_S,
            )
        for interface in self._interfaces.values():
            interface.publish()
            interface.rotation.update()
        self._forget([each for each in self._leaving if not each.rotation.is_busy])
        self._ticks += 1
        if self._ticks % TICKS_OF_FRAME == 0:
            self.page.refresh()

    def _welcome(self, turtle: Turtle) -> None:
        """Offer the interface of a new turtle; that of a turtle that it replaces is kept."""
        x, y, theta = _in_single_precision(turtle.x, turtle.y, turtle.theta)
        self.get_logger().info(
            f'Spawning turtle [{turtle.name}] at x=[{x:f}], y=[{y:f}], theta=[{theta:f}]'
        )
        if turtle.name in self._interfaces:
            self._interfaces[turtle.name].replace(turtle)
            return
        self._forget([each for each in self._leaving if each.name == turtle.name])
        self._interfaces[turtle.name] = TurtleInterface(self, self.world, turtle)

    def _dismiss(self, name: str) -> None:
        """Close the interface of a turtle; its action waits until results are sent."""
        interface = self._interfaces.pop(name)
        interface.close()
        self._leaving.append(interface)

    def _forget(self, interfaces: list[TurtleInterface]) -> None:
        """Destroy the actions of turtles that are no longer there."""
        for interface in interfaces:
            self._leaving.remove(interface)
            interface.rotation.destroy()

    def _clear(self, request: Any, response: Any) -> Any:
        self.get_logger().info('Clearing turtlesim.')
        self.world.canvas.clear()
        return response

    def _reset(self, request: Any, response: Any) -> Any:
        self.get_logger().info('Resetting turtlesim.')
        first = self.world.reset()
        for name in self._interfaces.keys() - {first.name}:
            self._dismiss(name)
        self._welcome(first)
        return response

    def _kill(self, request: Any, response: Any) -> Any:
        try:
            self.world.kill(request.name)
            self._dismiss(request.name)
        except TurtleError as error:
            self.get_logger().error(str(error))
        return response

    def _spawn(self, request: Any, response: Any) -> Any:
        try:
            if request.name:
                self._check_name(request.name)
            turtle = self.world.spawn(request.x, request.y, request.theta, request.name)
            self._welcome(turtle)
            response.name = turtle.name
        except TurtleError as error:
            self.get_logger().error(str(error))
        return response

    def _check_name(self, name: str) -> None:
        """Raise TurtleError if there can be no topics with the name of a turtle."""
        if not NAME.fullmatch(name):
            raise TurtleError(
                f'[{name}] cannot be the name of a turtle, as it is part of the names of topics: '
                'use letters, digits and underscores'
            )
        if len(self.get_namespace()) + len(name) > LONGEST_NAME:
            raise TurtleError(
                f'[{name}] cannot be the name of a turtle: with the namespace, it may have at '
                f'most {LONGEST_NAME} characters'
            )


def _in_single_precision(*numbers: float) -> NDArray[np.float32]:
    """Return numbers as messages have them, for the log."""
    with np.errstate(over='ignore'):
        return np.array(numbers, np.float32)
