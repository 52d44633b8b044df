# SPDX-License-Identifier: Apache-2.0
"""A marker in the scene, which further messages may change."""

from __future__ import annotations

from typing import Any, NamedTuple

from rviz_common.canvas import Canvas
from rviz_common.frames import Pose
from rviz_common.selection import Ray
from rviz_default_plugins.decoding.geometry import position, Quaternion, rotation
from rviz_default_plugins.markers.drawing import draw_look
from rviz_default_plugins.markers.hits import highlighted, hit_look
from rviz_default_plugins.markers.look import Look, look_of
from rviz_default_plugins.markers.mesh import MeshIsBeingRead

__all__ = ['Coming', 'ShownMarker']

NO_ROTATION: Quaternion = (1.0, 0.0, 0.0, 0.0)


class Coming(NamedTuple):
    """The newest message of a marker, and its reception time in ns of the node's clock."""

    marker: Any
    came_ns: int


class ShownMarker:
    """
    A marker in the scene, which further messages may change.

    Parameters
    ----------
    scene
        The scene of the viser server.
    place
        The path of the marker in the scene.

    Attributes
    ----------
    problem
        Why it is not shown, '' if it is.
    note
        A remark for the user.
    frame_id, stamp_ns
        Its frame, and the time in ns of the transform; 0 for the latest.
    is_locked
        Whether it follows its frame.

    """

    def __init__(self, scene: Any, place: str) -> None:
        self._scene = scene
        self._place = place
        self._node: Any = None
        self._look: Look | None = None
        self._is_placed = self._is_shown = False
        self._own = self._frame = self._pose = Pose()
        self._is_highlighted = False
        self._end_ns: int | None = None
        self._unfinished: Coming | None = None
        self.problem = ''
        self.note = ''
        self.frame_id = ''
        self.stamp_ns = 0
        self.is_locked = False

    def change(self, coming: Coming) -> None:
        """
        Draw the marker from a message; an invalid one removes it from the scene.

        Parameters
        ----------
        coming
            The message, with the action ADD, and its time of reception.

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
        """Draw the marker if it was waiting for a mesh."""
        if self._unfinished is not None:
            self.change(self._unfinished)

    def remove(self) -> None:
        """Remove the marker from the scene."""
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
        """Whether the pose of its frame is needed."""
        return self._node is not None and (self.is_locked or not self._is_placed)

    def place(self, frame: Pose) -> None:
        """
        Move the marker to the pose of its frame.

        Parameters
        ----------
        frame
            The pose of its frame in the fixed frame.

        """
        if self._is_placed and frame == self._frame:
            return
        self._is_placed, self._frame = True, frame
        self._pose = frame.of(self._own)
        self._node.position, self._node.wxyz = self._pose

    def move_anew(self) -> None:
        """Request a new placement, since the fixed frame has changed."""
        self._is_placed = False

    def show(self, is_shown: bool) -> None:
        """
        Hide the marker, or show it again.

        Parameters
        ----------
        is_shown
            Whether it is to be visible.

        """
        if self._node is not None and self._is_shown != is_shown:
            self._is_shown = self._node.visible = is_shown

    @property
    def pose(self) -> Pose | None:
        """The pose in the fixed frame, None if it is not shown."""
        return self._pose if self._is_shown else None

    def hit(self, ray: Ray) -> float | None:
        """
        Intersect a ray with the marker.

        Parameters
        ----------
        ray
            The ray, in the fixed frame.

        Returns
        -------
        float | None
            How many times the direction it is from the origin of the ray; None if the ray passes
            it by, or it is not shown.

        """
        if not self._is_shown or self._look is None:
            return None
        return hit_look(ray.seen_from(self._pose), self._look)

    def highlight(self, is_highlighted: bool) -> None:
        """
        Cover the marker with a translucent colour, or uncover it.

        Parameters
        ----------
        is_highlighted
            Whether it is to be covered, also when it changes.

        """
        self._is_highlighted = is_highlighted
        if self._node is not None:
            self._cover()

    @property
    def is_placed(self) -> bool:
        """Whether it has been placed."""
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
            self.note = 'its orientation is a quaternion of zeros, treated as the identity (w=1).'
            wxyz = NO_ROTATION
        else:
            wxyz = rotation(turn)
        self._own = Pose(position(marker.pose.position), wxyz)

    def _set_end(self, marker: Any, came_ns: int) -> None:
        lifetime_ns = marker.lifetime.sec * 1_000_000_000 + marker.lifetime.nanosec
        if lifetime_ns < 0:
            self.note = f'its lifetime of {lifetime_ns / 1e9:g} s is negative: it does not expire.'
        self._end_ns = came_ns + lifetime_ns if lifetime_ns > 0 else None

    def _draw(self, look: Look) -> None:
        self.note = look.note or self.note
        if look.is_like(self._look):
            return
        if self._node is None:
            self._node = self._scene.add_frame(self._place, show_axes=False, visible=False)
            self._canvas = Canvas(self._scene, self._place)
            self._highlight = Canvas(self._scene, f'{self._place}/highlight')
        with self._canvas.anew():
            draw_look(self._canvas, look)
        self._look = look
        self._cover()

    def _cover(self) -> None:
        """Draw the marker again, in the colour of highlighted ones."""
        with self._highlight.anew():
            if self._is_highlighted and self._look is not None:
                draw_look(self._highlight, highlighted(self._look))
