# SPDX-License-Identifier: Apache-2.0
"""Node that publishes joint commands to swing the arms."""

from __future__ import annotations

from dataclasses import dataclass
import math
import sys
from typing import Any

from builtin_interfaces.msg import Time
from humanoid_common.node_parameters import NodeParameters
from humanoid_common.parameters import parameter, ParameterError
from humanoid_common.periodic import PeriodicTimer
from humanoid_common.qos import COMMAND
from humanoid_common.running import run_node
from humanoid_control.emergency_stop import StopListener
from humanoid_control.sine_motion import JointCommand, motion_of, SineMotion, StoppableMotion
from rclpy.node import Node
from sensor_msgs.msg import JointState


@dataclass(frozen=True)
class JointControllerParameters:
    """Publishing rate, and the swing of each joint: every list has one element per joint."""

    rate_hz: float = parameter(
        50.0, 'Number of joint commands published per second.', at_least=1.0, at_most=1000.0
    )
    joints: tuple[str, ...] = parameter(
        ('left_shoulder', 'left_elbow', 'right_shoulder', 'right_elbow'),
        'Names of the joints to move.',
    )
    amplitudes_rad: tuple[float, ...] = parameter(
        (0.5, 0.8, 0.5, 0.8),
        'Amplitude of each joint.',
        at_least=-10.0,
        at_most=10.0,
    )
    frequencies_rad_s: tuple[float, ...] = parameter(
        (1.0, 1.5, 1.0, 1.5),
        'Angular frequency of each joint.',
        at_least=-1000.0,
        at_most=1000.0,
    )
    phases_rad: tuple[float, ...] = parameter(
        (0.0, 0.0, math.pi, math.pi),
        'Initial phase of each joint.',
        at_least=-100.0,
        at_most=100.0,
    )
    heartbeat_timeout_s: float = parameter(
        1.0,
        'How long the console in control may be silent before the joints are held.',
        at_least=0.2,
        at_most=10.0,
    )

    def __post_init__(self) -> None:
        """Validate the lists against each other."""
        self._check_names()
        for name in ('amplitudes_rad', 'frequencies_rad_s', 'phases_rad'):
            self._check_length(name, len(getattr(self, name)))

    @property
    def motion(self) -> SineMotion:
        """Return the motion that the parameters describe."""
        return motion_of(self.joints, self.amplitudes_rad, self.frequencies_rad_s, self.phases_rad)

    def _check_names(self) -> None:
        """Check that the joint names are unique and not empty."""
        if '' in self.joints:
            raise ParameterError(
                "Parameter 'joints' contains an empty name. Name every joint.", 'joints'
            )
        twice = sorted({joint for joint in self.joints if self.joints.count(joint) > 1})
        if twice:
            raise ParameterError(
                f"Parameter 'joints' names '{twice[0]}' more than once. Name every joint once.",
                'joints',
            )

    def _check_length(self, name: str, length: int) -> None:
        """Check that a list has one element for each joint."""
        if length != len(self.joints):
            raise ParameterError(
                f"Parameter '{name}' has {length} elements, but 'joints' has "
                f'{len(self.joints)}. Give one element per joint; to change the number of joints '
                'while the node runs, set all four lists in one atomic request.',
                name,
                'joints',
            )


class HumanoidJointController(Node):
    """
    Node that swings joints with commands on the topic `joint_commands`, until a stop.

    The motion follows the clock of the node: with `use_sim_time` it slows down and pauses with the
    simulation. The heartbeat of the console in control is checked by a steady clock.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('humanoid_joint_controller', **options)
        self._settings = NodeParameters(self, JointControllerParameters, self._change)
        parameters = self._settings.current
        self._motion = StoppableMotion(parameters.motion)
        self._stop = StopListener(self, parameters.heartbeat_timeout_s)
        self._publisher = self.create_publisher(JointState, 'joint_commands', COMMAND)
        self._timer = PeriodicTimer(self, parameters.rate_hz, self._publish)
        self.get_logger().info(f'Humanoid Joint Controller started ({parameters.rate_hz:g} Hz)')

    def _publish(self, now_s: float) -> None:
        """Publish the current command."""
        command = self._motion.command(now_s, self._stop.must_hold)
        if command is not None:
            stamp = self.get_clock().now().to_msg()
            self._publisher.publish(command_message(command, stamp))

    def _change(self, parameters: JointControllerParameters) -> None:
        """Apply changed parameters."""
        self._motion.change(parameters.motion, self._timer.now_s())
        self._stop.guard.heartbeat_timeout_s = parameters.heartbeat_timeout_s
        self._timer.set_rate(parameters.rate_hz)
        self.get_logger().info(f'Parameters changed: {parameters}')


def command_message(command: JointCommand, stamp: Time) -> JointState:
    """
    Convert a joint command to a JointState, with efforts of zero.

    Parameters
    ----------
    command
        Positions and velocities of the joints.
    stamp
        The stamp of the header.

    """
    message = JointState(
        name=command.joints,
        position=command.positions_rad,
        velocity=command.velocities_rad_s,
        effort=[0.0] * len(command.joints),
    )
    message.header.stamp = stamp
    return message


def main() -> int:
    """Run the node."""
    return run_node(HumanoidJointController)


if __name__ == '__main__':
    sys.exit(main())
