# SPDX-License-Identifier: Apache-2.0
"""Where frames are in the one that does not move on the screen."""

from __future__ import annotations

from typing import NamedTuple

from rclpy.time import Time
from tf2_ros import Buffer, TransformException

__all__ = ['FIXED_FRAME', 'FrameError', 'Frames', 'Pose']

FIXED_FRAME = '<Fixed Frame>'
"""What a property says that means the fixed frame, whichever it is."""


class Pose(NamedTuple):
    """A position in metres and a rotation as quaternion w, x, y, z, as the page wants them."""

    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    wxyz: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)


class FrameError(LookupError):
    """A pose that is not known, with the reason."""


class Frames:
    """Poses of frames, from the transforms of a buffer."""

    def __init__(self, buffer: Buffer, fixed_frame: str = 'map') -> None:
        """Take transforms from a buffer."""
        self.buffer = buffer
        self.fixed_frame = fixed_frame

    def pose(self, frame: str, stamp_ns: int = 0) -> Pose:
        """
        Return where a frame is in the fixed frame at a time, or raise FrameError.

        Time 0 is the latest one at which it is known.
        """
        return self.between(self.fixed_frame, frame, stamp_ns)

    def between(self, target: str, source: str, stamp_ns: int = 0) -> Pose:
        """Return where a frame is in another one at a time, or raise FrameError."""
        target, source = self._named(target), self._named(source)
        if target == source:
            return Pose()
        try:
            found = self.buffer.lookup_transform(target, source, Time(nanoseconds=stamp_ns))
        except TransformException as error:
            raise FrameError(str(error)) from error
        at, turn = found.transform.translation, found.transform.rotation
        return Pose((at.x, at.y, at.z), (turn.w, turn.x, turn.y, turn.z))

    def _named(self, frame: str) -> str:
        return self.fixed_frame if frame == FIXED_FRAME else frame.lstrip('/')
