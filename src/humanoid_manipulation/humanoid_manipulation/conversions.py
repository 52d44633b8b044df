# SPDX-License-Identifier: Apache-2.0
"""From frames to messages."""

from __future__ import annotations

from geometry_msgs.msg import PoseStamped
from humanoid_control.dynamics.frames import Frame
import mujoco
import numpy as np

__all__ = ['fill_pose']


def fill_pose(message: PoseStamped, name: str, frame: Frame) -> None:
    """Fill in where something is in the frame of a name."""
    turn = np.zeros(4)
    mujoco.mju_mat2Quat(turn, np.ascontiguousarray(frame.rotation).ravel())
    message.header.frame_id = name
    position, orientation = message.pose.position, message.pose.orientation
    position.x, position.y, position.z = frame.position_m.tolist()
    orientation.w, orientation.x, orientation.y, orientation.z = turn.tolist()
