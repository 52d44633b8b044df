# SPDX-License-Identifier: Apache-2.0
"""Drive a turtle with the keys of a terminal."""

from __future__ import annotations

from collections.abc import Callable
import math
import re
import sys
from typing import Any

from geometry_msgs.msg import Twist
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.action import ActionClient
from rclpy.node import Node
from ros2bag.api.control import DOWN, Keyboard, RIGHT, UP
from tf2_ros.executing import make_executor
from tf2_ros.program import wait_for_signal
from turtlesim.action import RotateAbsolute

__all__ = ['TeleopNode', 'keys_of', 'teleoperate']

LEFT = '\x1b[D'
MOVES = {UP: (1, 0), DOWN: (-1, 0), LEFT: (0, 1), RIGHT: (0, -1)}
"""Forward and turn to the left, each as a share of the scale, by key."""
AROUND_F = 'gtredcvb'
"""The keys around F, counterclockwise from the one to its right: 45 degrees apart."""
HEADINGS = {key: math.remainder(i * math.pi / 4, math.tau) for i, key in enumerate(AROUND_F)}
CANCEL, QUIT = 'f', 'q'
KEY = re.compile(r'\x1b\[[0-9;]*[@-~]|\x1bO.|.', re.DOTALL)
UNFINISHED = re.compile(r'\x1b(\[[0-9;]*|O)?\Z')
POLL_S = 0.02
HELP = """\
Reading from keyboard
---------------------------
Use arrow keys to move the turtle.
Use G|B|V|C|D|E|R|T keys to rotate to absolute orientations. 'F' to cancel a rotation.
'Q' to quit.\
"""
DEPTH = 10


def keys_of(text: str) -> tuple[list[str], str]:
    """
    Split what a terminal sends into keys: letters in lower case, others as escape sequences.

    Parameters
    ----------
    text
        What the terminal has sent. In its application mode, arrows begin with ESC O.

    Returns
    -------
    tuple[list[str], str]
        The keys, and the beginning of an escape sequence whose remainder has not come yet.

    """
    unfinished = UNFINISHED.search(text)
    rest = unfinished.group() if unfinished else ''
    keys = KEY.findall(text.removesuffix(rest))
    return [key.replace('\x1bO', '\x1b[') if key[1:] else key.lower() for key in keys], rest


class TeleopNode(Node):
    """
    Node that sends what keys mean to a turtle.

    Raises
    ------
    rclpy.exceptions.ParameterException
        A parameter has a value of another type.

    """

    def __init__(self) -> None:
        super().__init__('teleop_turtle')
        self._scale_linear = self._declare('scale_linear', 'The velocity of the arrows up, down.')
        self._scale_angular = self._declare(
            'scale_angular', 'The angular velocity of the arrows left, right.'
        )
        self._commands = self.create_publisher(Twist, 'turtle1/cmd_vel', DEPTH)
        self._rotation = ActionClient(self, RotateAbsolute, 'turtle1/rotate_absolute')
        self._goal: Any = None
        """The future of the last goal's handle."""

    def press(self, key: str) -> None:
        """
        Do what a key means; others are ignored.

        Parameters
        ----------
        key
            The key, as from `keys_of`.

        """
        if key in MOVES:
            forward, turn = MOVES[key]
            message = Twist()
            message.linear.x = self._scale_linear() * forward
            message.angular.z = self._scale_angular() * turn
            self._commands.publish(message)
        elif key in HEADINGS:
            self._rotate(HEADINGS[key])
        elif key == CANCEL and self._goal is not None:
            self._goal.add_done_callback(_cancel)
            self._goal = None

    def _rotate(self, heading: float) -> None:
        if not self._rotation.server_is_ready():
            name = self.resolve_service_name('turtle1/rotate_absolute')
            self.get_logger().error(f'No node offers the action {name}: start turtlesim_node')
            return
        goal = RotateAbsolute.Goal(theta=heading)
        self._goal = self._rotation.send_goal_async(goal)

    def _declare(self, name: str, text: str) -> Any:
        self.declare_parameter(name, 2.0, ParameterDescriptor(description=text))
        return lambda: self.get_parameter(name).value


def _cancel(accepted: Any) -> None:
    """Cancel a goal; one that has ended meanwhile is left alone by its server."""
    handle = accepted.result()
    if handle.accepted:
        handle.cancel_goal_async()


def teleoperate(make_node: Callable[[], TeleopNode]) -> int:
    """
    Read keys until Q or a signal; the terminal is as before afterwards.

    Parameters
    ----------
    make_node
        Creates the node.

    Returns
    -------
    int
        The exit status.

    """
    with Keyboard(enabled=True) as keyboard:
        if not keyboard.is_reading:
            sys.stderr.write(
                'turtle_teleop_key reads the keys of a terminal, and this is none, or not in its '
                'foreground. Start it with `ros2 run` in a terminal, not from a launch file.\n'
            )
            return 1
        node = make_node()
        executor = make_executor()
        executor.add_node(node)
        print(HELP, flush=True)
        rest = ''
        while not wait_for_signal(0.0):
            executor.spin_once(timeout_sec=POLL_S)
            keys, rest = keys_of(rest + keyboard.pressed())
            for key in keys:
                node.press(key)
            if QUIT in keys:
                break
        executor.shutdown()
        node.destroy_node()
    return 0
