# SPDX-License-Identifier: Apache-2.0
"""The node that publishes velocities for keys."""

from __future__ import annotations

from collections.abc import Callable
import re
import sys
from typing import Any

from geometry_msgs.msg import Twist, TwistStamped
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.duration import Duration
from rclpy.node import Node
from ros2bag.api.control import Keyboard
from teleop_twist_keyboard.driving import Driving, HELP
from tf2_ros.executing import make_executor
from tf2_ros.program import wait_for_signal

__all__ = ['TeleopNode', 'teleoperate']

KEY = re.compile(r'\x1b\[[0-9;]*[@-~]|\x1bO.|.', re.DOTALL)
POLL_S, ACKNOWLEDGED_S = 0.02, 0.5
DEPTH = 10


class TeleopNode(Node):
    """
    Node that publishes a velocity on `cmd_vel` for each key.

    Raises
    ------
    rclpy.exceptions.ParameterException
        A parameter has a value of another type.

    """

    def __init__(self) -> None:
        super().__init__('teleop_twist_keyboard')
        self._is_stamped = self._declare('stamped', False, 'Publish TwistStamped, not Twist.')
        self._frame = self._declare('frame_id', '', 'The frame of stamped velocities.')
        self.driving = Driving(
            self._declare('speed', 0.5, 'The linear speed in m/s; keys change it.'),
            self._declare('turn', 1.0, 'The angular speed in rad/s; keys change it.'),
        )
        kind = TwistStamped if self._is_stamped else Twist
        self._publisher = self.create_publisher(kind, 'cmd_vel', DEPTH)

    def press(self, key: str) -> str:
        """
        Do what a key means, and publish the velocity.

        Parameters
        ----------
        key
            The key.

        Returns
        -------
        str
            What to show; '' for nothing.

        """
        shown = self.driving.press(key)
        self._publish()
        return shown

    def stop(self) -> None:
        """Publish that the robot stands, and wait until that is received."""
        self.driving.press('k')
        self._publish()
        self._publisher.wait_for_all_acked(Duration(seconds=ACKNOWLEDGED_S))

    def _publish(self) -> None:
        velocity = self.driving.velocity
        twist = Twist()
        twist.linear.x, twist.linear.y, twist.linear.z = velocity[:3]
        twist.angular.z = velocity.yaw
        if not self._is_stamped:
            self._publisher.publish(twist)
            return
        stamped = TwistStamped(twist=twist)
        stamped.header.stamp = self.get_clock().now().to_msg()
        stamped.header.frame_id = self._frame
        self._publisher.publish(stamped)

    def _declare(self, name: str, default: Any, text: str) -> Any:
        descriptor = ParameterDescriptor(description=text, read_only=True)
        return self.declare_parameter(name, default, descriptor).value


def teleoperate(make_node: Callable[[], TeleopNode]) -> int:
    """
    Read keys until Ctrl-C, and stop the robot then; the terminal is as before afterwards.

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
                'teleop_twist_keyboard reads the keys of a terminal, and this is none, or not in '
                'its foreground. Start it with `ros2 run` in a terminal, not from a launch file.\n'
            )
            return 1
        node = make_node()
        executor = make_executor()
        executor.add_node(node)
        print(f'{HELP}\n{node.driving.speeds}', flush=True)
        while not wait_for_signal(0.0):
            executor.spin_once(timeout_sec=POLL_S)
            for key in KEY.findall(keyboard.pressed()):
                shown = node.press(key)
                if shown:
                    print(shown, flush=True)
        node.stop()
        executor.shutdown()
        node.destroy_node()
    return 0
