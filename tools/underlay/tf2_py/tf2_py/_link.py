# SPDX-License-Identifier: Apache-2.0
"""What a frame's parent is at a time, and where the frame is in it."""

from __future__ import annotations

from typing import NamedTuple

from tf2_py._pose import interpolate, Pose


class Sample(NamedTuple):
    """What a broadcaster has said of a frame."""

    stamp_ns: int
    parent: str
    pose: Pose
    authority: str


class Link(NamedTuple):
    """The way from a frame to its parent, between two samples."""

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
    """There are samples, but none around the time that is asked for."""

    def __init__(self, requested_ns: int, oldest_ns: int, latest_ns: int) -> None:
        super().__init__()
        self.requested_ns = requested_ns
        self.oldest_ns = oldest_ns
        self.latest_ns = latest_ns
