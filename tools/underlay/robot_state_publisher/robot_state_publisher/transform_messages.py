# SPDX-License-Identifier: Apache-2.0
"""Reusable transform messages for tf."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from builtin_interfaces.msg import Time
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage
from urdf import Joint
from urdf.kinematics import Pose

__all__ = ['TransformMessages']


class TransformMessages:
    """
    A message with the transforms of a set of joints, which is built once and reused.

    Parameters
    ----------
    joints
        The joints, in the order of the transforms.
    frame_prefix
        The prefix of all frame names.

    Attributes
    ----------
    message
        The `tf2_msgs/TFMessage`.

    """

    def __init__(self, joints: Sequence[Joint], frame_prefix: str) -> None:
        self._stamp = Time()
        self.message = TFMessage(
            transforms=[_transform(joint, frame_prefix, self._stamp) for joint in joints]
        )
        self._places = [
            (each.transform.translation, each.transform.rotation)
            for each in self.message.transforms
        ]

    def fill(self, stamp: Time, poses: Iterable[Pose]) -> TFMessage:
        """
        Set the stamp and the poses of the message.

        Parameters
        ----------
        stamp
            The stamp of all transforms.
        poses
            Pose of the child link of each joint relative to its parent link, in the order of the
            joints.

        Returns
        -------
        TFMessage
            The same message object on each call.

        """
        self._stamp.sec, self._stamp.nanosec = stamp.sec, stamp.nanosec
        for (at, turn), pose in zip(self._places, poses):
            at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w = pose
        return self.message


def _transform(joint: Joint, frame_prefix: str, stamp: Time) -> TransformStamped:
    """Create the message of one joint; all messages share the stamp."""
    transform = TransformStamped(child_frame_id=frame_prefix + joint.child)
    transform.header.frame_id = frame_prefix + joint.parent
    transform.header.stamp = stamp
    return transform
