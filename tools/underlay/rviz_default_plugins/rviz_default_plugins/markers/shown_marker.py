# SPDX-License-Identifier: Apache-2.0
"""A marker in the scene."""

from __future__ import annotations

from typing import Any

import numpy as np
from rviz_common.canvas import Canvas
from rviz_common.frames import Pose
from rviz_default_plugins.decoding.geometry import (
    joined,
    position,
    Quaternion,
    rotated,
    rotation,
)
from rviz_default_plugins.markers.drawing import draw_look
from rviz_default_plugins.markers.inbox import Coming
from rviz_default_plugins.markers.look import Look, look_of
from rviz_default_plugins.markers.mesh import MeshIsBeingRead

__all__ = ['ShownMarker']

NO_ROTATION: Quaternion = (1.0, 0.0, 0.0, 0.0)


class ShownMarker:
    """
    A marker in the scene, which may be changed by further messages.

    Parameters
    ----------
    scene
        The scene of the viser server.
    place
        The path of the scene where it is drawn.

    Attributes
    ----------
    problem
        Why it is not shown, '' if it is.
    note
        What else there is to know.
    frame_id, stamp_ns
        The frame that it is in, and the time in ns at which that counts; 0 for the latest.
    is_locked
        Whether it follows its frame.

    """

    def __init__(self, scene: Any, place: str) -> None:
        self._scene = scene
        self._place = place
        self._node: Any = None
        self._look: Look | None = None
        self._is_placed = self._is_shown = False
        self._own = self._frame = Pose()
        self._end_ns: int | None = None
        self._unfinished: Coming | None = None
        self.problem = ''
        self.note = ''
        self.frame_id = ''
        self.stamp_ns = 0
        self.is_locked = False

    def change(self, coming: Coming) -> None:
        """
        Draw the marker as a message says; an invalid one leaves nothing to be seen.

        Parameters
        ----------
        coming
            The message, of the action ADD, and when it came.

        """
        marker = coming.marker
        self.note = self.problem = ''
        self._is_placed = False
        self._unfinished = None
        try:
            self._set_place(marker)
            self._set_end(marker, coming.came_ns)
            self._draw(look_of(marker))
        except ValueError as error:
            self.problem = str(error)
            if isinstance(error, MeshIsBeingRead):
                self._unfinished = coming
            self.remove()

    def finish(self) -> None:
        """Draw what had to wait for a mesh."""
        if self._unfinished is not None:
            self.change(self._unfinished)

    def remove(self) -> None:
        """Remove it from the scene."""
        if self._node is not None:
            self._node.remove()
        self._node = self._look = None
        self._is_shown = False

    def is_over(self, now_ns: int) -> bool:
        """
        Whether the lifetime of the marker has ended.

        Parameters
        ----------
        now_ns
            The time in ns of the node's clock.

        """
        return self._end_ns is not None and now_ns >= self._end_ns

    @property
    def needs_pose(self) -> bool:
        """Tell if it has to be known where its frame is."""
        return self._node is not None and (self.is_locked or not self._is_placed)

    def place(self, frame: Pose) -> None:
        """
        Move the marker to where its frame is.

        Parameters
        ----------
        frame
            The pose of its frame in the fixed frame.

        """
        if self._is_placed and frame == self._frame:
            return
        self._is_placed, self._frame = True, frame
        offset = rotated(np.array([self._own.position]), frame.wxyz)[0]
        at = tuple(float(a + b) for a, b in zip(offset, frame.position))
        self._node.position = at
        self._node.wxyz = joined(frame.wxyz, self._own.wxyz)

    def move_anew(self) -> None:
        """Have its place found anew, since the fixed frame has changed."""
        self._is_placed = False

    def show(self, is_shown: bool) -> None:
        """
        Hide the marker, or show it again.

        Parameters
        ----------
        is_shown
            Whether it is to be seen.

        """
        if self._node is not None and self._is_shown != is_shown:
            self._is_shown = self._node.visible = is_shown

    @property
    def is_placed(self) -> bool:
        """Tell if it is known where it is."""
        return self._is_placed

    def _set_place(self, marker: Any) -> None:
        stamp = marker.header.stamp
        self.frame_id = marker.header.frame_id
        self.stamp_ns = max(0, stamp.sec * 1_000_000_000 + stamp.nanosec)
        self.is_locked = marker.frame_locked
        if self.is_locked:
            self.stamp_ns = 0
        turn = marker.pose.orientation
        if (turn.x, turn.y, turn.z, turn.w) == (0.0, 0.0, 0.0, 0.0):
            self.note = 'its orientation is a quaternion of zeros, taken for no rotation (w=1).'
            wxyz = NO_ROTATION
        else:
            wxyz = rotation(turn)
        self._own = Pose(position(marker.pose.position), wxyz)

    def _set_end(self, marker: Any, came_ns: int) -> None:
        lifetime_ns = marker.lifetime.sec * 1_000_000_000 + marker.lifetime.nanosec
        if lifetime_ns < 0:
            self.note = f'its lifetime of {lifetime_ns / 1e9:g} s is negative, taken for no end.'
        self._end_ns = came_ns + lifetime_ns if lifetime_ns > 0 else None

    def _draw(self, look: Look) -> None:
        self.note = look.note or self.note
        if look.is_like(self._look):
            return
        if self._node is None:
            self._node = self._scene.add_frame(self._place, show_axes=False, visible=False)
            self._canvas = Canvas(self._scene, self._place)
        with self._canvas.anew():
            draw_look(self._canvas, look)
        self._look = look
