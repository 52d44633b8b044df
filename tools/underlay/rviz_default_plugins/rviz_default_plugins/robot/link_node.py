# SPDX-License-Identifier: Apache-2.0
"""The node of the scene that a link is drawn below."""

from __future__ import annotations

from rviz_common.frames import Pose
from viser import FrameHandle

__all__ = ['LinkNode']


class LinkNode:
    """A node that is sent to browsers only when it moves, and then only what changes of it."""

    def __init__(self, handle: FrameHandle) -> None:
        """Take a node that is not visible, at the origin."""
        self._handle = handle
        self._pose = Pose()
        self._is_visible = False

    def place(self, pose: Pose | None) -> None:
        """Show the node at a place; hide it, with all below it, if the place is not known."""
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
