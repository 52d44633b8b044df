# SPDX-License-Identifier: Apache-2.0
"""Convert joint commands to messages."""

from __future__ import annotations

from builtin_interfaces.msg import Time
from humanoid_control.joint_command import JointCommand
from sensor_msgs.msg import JointState


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
