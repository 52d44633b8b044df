# SPDX-License-Identifier: Apache-2.0
"""Links between frames and their parents at a time."""

from __future__ import annotations

from typing import NamedTuple

from tf2_py._pose import interpolate, Pose


class Sample(NamedTuple):
    """A transform of a frame as received from a broadcaster."""

    stamp_ns: int
    parent: str
    pose: Pose
    authority: str


class Link(NamedTuple):
    """The link from a frame to its parent, interpolated between two samples."""

    parent: str
    earlier: Pose
    later: Pose
    fraction: float

    def pose(self) -> Pose:
        """Return the pose of the frame in its parent."""
        if not self.fraction:
            return self.earlier
        return interpolate(self.earlier, self.later, self.fraction)


class Gap(Exception):
    """The samples do not cover the requested time."""

    def __init__(self, requested_ns: int, oldest_ns: int, latest_ns: int) -> None:
        super().__init__()
        self.requested_ns = requested_ns
        self.oldest_ns = oldest_ns
        self.latest_ns = latest_ns
