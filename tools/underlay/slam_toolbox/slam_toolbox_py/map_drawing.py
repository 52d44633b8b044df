# SPDX-License-Identifier: Apache-2.0
"""Keep the occupancy grid of the keyframes, and draw it anew after they have moved."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from slam_toolbox_py.mapper import Mapper
from slam_toolbox_py.occupancy import Grid, OccupancyCounts
from slam_toolbox_py.poses import FloatArray, wrap

__all__ = ['MapDrawing']

_AT_ONCE = 15
_MOVED_RAD = 0.01


class MapDrawing:
    """
    The grid of what keyframes have seen.

    Parameters
    ----------
    resolution_m
        Width of a cell.

    """

    def __init__(self, resolution_m: float) -> None:
        self.resolution_m = resolution_m
        self._counts = OccupancyCounts(resolution_m)
        self._drawn: FloatArray = np.zeros((0, 3))
        """(N, 3) poses at which the keyframes were drawn."""

    def backlog(self, mapper: Mapper) -> int:
        """Return how many keyframes are to be drawn."""
        drawn = 0 if self._has_moved(mapper) else len(self._drawn)
        return len(mapper.keyframes) - drawn

    def drawing(self, mapper: Mapper) -> Iterator[None]:
        """Draw what is new, or all if keyframes have moved, in steps of some milliseconds."""
        if self._has_moved(mapper):
            counts, poses = OccupancyCounts(self.resolution_m), mapper.graph.poses.copy()
            for i, pose in enumerate(poses):
                counts.add(mapper.keyframes[i].scan, pose)
                if i % _AT_ONCE == _AT_ONCE - 1:
                    yield
            self._counts, self._drawn = counts, poses
            return
        for i in range(len(self._drawn), len(mapper.keyframes)):
            pose = mapper.graph.poses[i]
            self._counts.add(mapper.keyframes[i].scan, pose)
            self._drawn = np.concatenate([self._drawn, pose[None]])
            if i % _AT_ONCE == _AT_ONCE - 1:
                yield

    def update(self, mapper: Mapper) -> None:
        """Draw all that is to be drawn, now."""
        for _ in self.drawing(mapper):
            pass

    def grid(self, min_pass_through: int, occupancy_threshold: float) -> Grid | None:
        """Return the grid; see `OccupancyCounts.grid`."""
        return self._counts.grid(min_pass_through, occupancy_threshold)

    def _has_moved(self, mapper: Mapper) -> bool:
        poses = mapper.graph.poses
        if len(poses) < len(self._drawn):
            return True
        away = poses[: len(self._drawn)] - self._drawn
        return bool(
            (np.abs(away[:, :2]) > 0.4 * self.resolution_m).any()
            or (np.abs(wrap(away[:, 2])) > _MOVED_RAD).any()
        )
