# SPDX-License-Identifier: Apache-2.0
"""How the occupancy grid of a map is drawn from scans, and redrawn after keyframes have moved."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt
from slam_toolbox_py.mapper import Mapper
from slam_toolbox_py.poses import FloatArray, transform, wrap
from slam_toolbox_py.scans import Scan

__all__ = ['FREE', 'OCCUPIED', 'UNKNOWN', 'Grid', 'MapDrawing', 'OccupancyCounts']

FREE, OCCUPIED, UNKNOWN = 0, 100, -1
_GROW_CELLS = 40
_SHIFT = 6

_AT_ONCE = 15
_MOVED_RAD = 0.01


@dataclass(frozen=True)
class Grid:
    """An occupancy grid, as in `nav_msgs/OccupancyGrid`."""

    cells: npt.NDArray[np.int8]
    """(rows, columns) of FREE, OCCUPIED and UNKNOWN; row 0 at the lowest y."""
    origin: FloatArray
    """(2,) outer corner of the cell [0, 0], in m."""
    resolution_m: float


class OccupancyCounts:
    """
    Counts of hits and passes, in a grid that grows with the scans.

    Parameters
    ----------
    resolution_m
        The cell size.

    """

    def __init__(self, resolution_m: float) -> None:
        self.resolution_m = resolution_m
        self._corner = np.zeros(2, dtype=np.int64)
        """The cell [0, 0], in cells from the origin of the map: x, y."""
        self._hits = np.zeros((0, 0), dtype=np.int32)
        self._passes = np.zeros((0, 0), dtype=np.int32)

    def add(self, scan: Scan, pose: FloatArray) -> None:
        """
        Count the cells that a scan hits and sweeps.

        The area between the beams, up to one cell before their ends, counts as swept once.

        Parameters
        ----------
        scan, pose
            The scan and its (3,) pose in the map.

        """
        points = transform(pose, scan.points)
        sensor = transform(pose, scan.origin[None])
        outline = transform(pose, scan.outline) - sensor
        length = np.hypot(*outline.T)
        shorter = np.maximum(length - self.resolution_m, 0.0) / np.maximum(length, 1e-6)
        outline = sensor + outline * shorter[:, None]
        self._cover(np.concatenate([points, outline, sensor]))
        swept = np.zeros(self._hits.shape, dtype=np.uint8)
        # OpenCV draws with the centres of cells at integer coordinates.
        corners = outline / self.resolution_m - self._corner - 0.5
        fixed = np.rint(corners * (1 << _SHIFT)).astype(np.int32)
        cv2.fillPoly(swept, [fixed], 1, lineType=cv2.LINE_8, shift=_SHIFT)
        cells = np.floor(points / self.resolution_m).astype(np.int64) - self._corner
        swept[cells[:, 1], cells[:, 0]] = 0
        self._passes += swept
        hit = np.zeros(self._hits.shape, dtype=bool)
        hit[cells[:, 1], cells[:, 0]] = True
        self._hits += hit

    def grid(self, min_pass_through: int, occupancy_threshold: float) -> Grid | None:
        """
        Classify the cells.

        Parameters
        ----------
        min_pass_through
            Cells observed by fewer scans are unknown, unless all of those scans hit them.
        occupancy_threshold
            Cells hit by a greater fraction of the scans are occupied.

        Returns
        -------
        The known part of the grid; None if no cell is known.

        """
        seen = self._hits + self._passes
        rows, columns = np.flatnonzero(seen.any(axis=1)), np.flatnonzero(seen.any(axis=0))
        if not len(rows):
            return None
        part = slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
        seen, hits = seen[part], self._hits[part]
        is_occupied = (hits > occupancy_threshold * seen) & (seen > 0)
        is_known = seen >= min(min_pass_through, int(seen.max()))
        cells = np.full(seen.shape, UNKNOWN, dtype=np.int8)
        cells[is_known] = FREE
        cells[is_occupied & (is_known | (hits == seen))] = OCCUPIED
        origin = (self._corner + [columns[0], rows[0]]) * self.resolution_m
        return Grid(cells, origin, self.resolution_m)

    def _cover(self, points: FloatArray) -> None:
        """Grow the grid so that it contains points, in m."""
        low = np.floor(points.min(axis=0) / self.resolution_m).astype(np.int64) - 1
        high = np.floor(points.max(axis=0) / self.resolution_m).astype(np.int64) + 2
        if not self._hits.size:
            self._corner = low
        end = self._corner + self._hits.shape[::-1]
        before = -(-np.maximum(self._corner - low, 0) // _GROW_CELLS) * _GROW_CELLS
        after = -(-np.maximum(high - end, 0) // _GROW_CELLS) * _GROW_CELLS
        if before.any() or after.any():
            margins = [(int(before[1]), int(after[1])), (int(before[0]), int(after[0]))]
            self._hits = np.pad(self._hits, margins)
            self._passes = np.pad(self._passes, margins)
            self._corner = self._corner - before


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
