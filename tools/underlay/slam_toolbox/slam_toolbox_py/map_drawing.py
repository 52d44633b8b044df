# SPDX-License-Identifier: Apache-2.0
"""The occupancy grid of the keyframes, redrawn after they have moved."""

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
    The occupancy grid drawn from the keyframes.

    Parameters
    ----------
    resolution_m
        The cell size.

    """

    def __init__(self, resolution_m: float) -> None:
        self.resolution_m = resolution_m
        self._counts = OccupancyCounts(resolution_m)
        self._drawn: FloatArray = np.zeros((0, 3))
        """(N, 3) poses at which the keyframes were drawn."""

    def backlog(self, mapper: Mapper) -> int:
        """
        Count the keyframes that are yet to be drawn.

        Parameters
        ----------
        mapper
            The keyframes; all of them count if any has moved since it was drawn.

        """
        drawn = 0 if self._has_moved(mapper) else len(self._drawn)
        return len(mapper.keyframes) - drawn

    def drawing(self, mapper: Mapper) -> Iterator[None]:
        """
        Draw new keyframes, or all if any has moved, in steps of some milliseconds.

        Parameters
        ----------
        mapper
            The keyframes.

        Yields
        ------
        None
            After every 15 keyframes.

        """
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
        """
        Draw new keyframes, or all if any has moved, at once.

        Parameters
        ----------
        mapper
            The keyframes.

        """
        for _ in self.drawing(mapper):
            pass

    def grid(self, min_pass_through: int, occupancy_threshold: float) -> Grid | None:
        """
        Compute the occupancy grid of the drawn keyframes.

        Parameters
        ----------
        min_pass_through, occupancy_threshold
            As for `OccupancyCounts.grid`.

        Returns
        -------
        Grid or None
            The known part of the grid; None if no cell is known.

        """
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
