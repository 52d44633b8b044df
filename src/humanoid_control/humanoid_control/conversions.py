# SPDX-License-Identifier: Apache-2.0
"""Turn the motion into messages."""

from __future__ import annotations

from builtin_interfaces.msg import Time
from humanoid_control.sine_motion import Motion
from sensor_msgs.msg import JointState


def command_message(motion: Motion, now_s: float, stamp: Time) -> JointState:
    """Return the command of a moment: position, its derivative, and no additional effort."""
    message = JointState(
        name=motion.joints,
        position=motion.positions_rad(now_s),
        velocity=motion.velocities_rad_s(now_s),
        effort=[0.0] * len(motion.swings),
    )
    message.header.stamp = stamp
    return message
