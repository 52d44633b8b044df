# SPDX-License-Identifier: Apache-2.0
"""The topics, services and action of one turtle."""

from __future__ import annotations

from collections.abc import Callable
import time
from typing import Any, TYPE_CHECKING

from geometry_msgs.msg import Twist
from turtlesim.msg import Color, Pose
from turtlesim.srv import SetPen, TeleportAbsolute, TeleportRelative
from turtlesim_py.canvas import Pen
from turtlesim_py.rotation_server import RotationServer
from turtlesim_py.turtle import Turtle, Velocity
from turtlesim_py.world import TurtleError, World

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['TurtleInterface']

DEPTH = 10
ERROR_PERIOD_S = 1.0


class TurtleInterface:
    """
    The topics, services and action of a turtle, below its name.

    Parameters
    ----------
    node
        The node that offers them.
    world, turtle
        The field, and the turtle in it.

    """

    def __init__(self, node: Node, world: World, turtle: Turtle) -> None:
        self.name = turtle.name
        self._node = node
        self._world = world
        self._turtle = turtle
        name = self.name
        self._poses = node.create_publisher(Pose, f'{name}/pose', DEPTH)
        self._colours = node.create_publisher(Color, f'{name}/color_sensor', DEPTH)
        self._commands = node.create_subscription(
            Twist, f'{name}/cmd_vel', self._on_command, DEPTH
        )
        self._services = [
            node.create_service(SetPen, f'{name}/set_pen', self._set_pen),
            node.create_service(
                TeleportAbsolute, f'{name}/teleport_absolute', self._teleport_absolute
            ),
            node.create_service(
                TeleportRelative, f'{name}/teleport_relative', self._teleport_relative
            ),
        ]
        self.rotation = RotationServer(node, f'{name}/rotate_absolute', turtle)

    def replace(self, turtle: Turtle) -> None:
        """
        Offer the interface for another turtle of the same name.

        Parameters
        ----------
        turtle
            The other turtle.

        """
        self._turtle = turtle
        self.rotation.replace(turtle)

    def publish(self) -> None:
        """Publish what somebody listens to."""
        turtle = self._turtle
        if self._poses.get_subscription_count():
            self._poses.publish(
                Pose(
                    x=turtle.x,
                    y=turtle.y,
                    theta=turtle.theta,
                    linear_velocity=turtle.velocity.linear,
                    angular_velocity=turtle.velocity.turn,
                )
            )
        if self._colours.get_subscription_count():
            red, green, blue = turtle.under
            self._colours.publish(Color(r=red, g=green, b=blue))

    def close(self) -> None:
        """Stop listening and offering; the action is left until `rotation` is no longer busy."""
        self.rotation.close()
        self._node.destroy_subscription(self._commands)
        for publisher in (self._poses, self._colours):
            self._node.destroy_publisher(publisher)
        for service in self._services:
            self._node.destroy_service(service)

    def _on_command(self, message: Twist) -> None:
        velocity = Velocity(message.linear.x, message.linear.y, message.angular.z)
        try:
            self._world.command(self.name, velocity, time.monotonic())
        except TurtleError as error:
            self._node.get_logger().error(
                f'Ignored a command on {self._commands.topic_name}. {error}',
                throttle_duration_sec=ERROR_PERIOD_S,
            )

    def _set_pen(self, request: Any, response: Any) -> Any:
        colour = request.r, request.g, request.b
        self._turtle.pen = Pen(colour, request.width, bool(request.off))
        return response

    def _teleport_absolute(self, request: Any, response: Any) -> Any:
        return self._try(
            lambda: self._world.teleport(self._turtle, request.x, request.y, request.theta),
            response,
        )

    def _teleport_relative(self, request: Any, response: Any) -> Any:
        return self._try(
            lambda: self._world.teleport_by(self._turtle, request.linear, request.angular),
            response,
        )

    def _try(self, work: Callable[[], None], response: Any) -> Any:
        """Do something, or log why it is not possible; return the response."""
        try:
            work()
        except TurtleError as error:
            self._node.get_logger().error(f'Cannot teleport turtle [{self.name}]. {error}')
        return response
