# SPDX-License-Identifier: Apache-2.0
"""The node of the scene for a link."""

from __future__ import annotations

from rviz_common.frames import Pose
from viser import FrameHandle

__all__ = ['LinkNode']


class LinkNode:
    """
    A node of the scene of which only changes are sent to browsers.

    Parameters
    ----------
    handle
        The handle of viser for an invisible node at the origin.

    """

    def __init__(self, handle: FrameHandle) -> None:
        self._handle = handle
        self._pose = Pose()
        self._is_visible = False

    def place(self, pose: Pose | None) -> None:
        """
        Move the node, and show it; hide it and all nodes below it if its pose is unknown.

        Parameters
        ----------
        pose
            The pose relative to the parent node, None if it is unknown.

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
