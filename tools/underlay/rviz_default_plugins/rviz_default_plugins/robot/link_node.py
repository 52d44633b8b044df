# SPDX-License-Identifier: Apache-2.0
"""The node of the scene that a link is drawn below."""

from __future__ import annotations

from rviz_common.frames import Pose
from viser import FrameHandle

__all__ = ['LinkNode']


class LinkNode:
    """
    A node of the scene that is sent to browsers only when it moves, and only what changes of it.

    Parameters
    ----------
    handle
        The handle of viser for a node that is not visible, at the origin.

    """

    def __init__(self, handle: FrameHandle) -> None:
        self._handle = handle
        self._pose = Pose()
        self._is_visible = False

    def place(self, pose: Pose | None) -> None:
        """
        Move the node, and show it; hide it with all below it if its pose is not known.

        Parameters
        ----------
        pose
            The pose in the node above, None if it is not known.

        """
        if (pose is not None) != self._is_visible:
            self._is_visible = pose is not None
            self._handle.visible = self._is_visible
        if pose is None or pose == self._pose:
            return
        if pose.position != self._pose.position:
            self._handle.position = pose.position
        if pose.wxyz != self._pose.wxyz:
            self._handle.wxyz = pose.wxyz
        self._pose = pose
