# SPDX-License-Identifier: Apache-2.0
"""A run of the mapper or the localizer: scheduling of scans, loop closure and drawing."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
import time

import numpy as np
from slam_toolbox_py.localizer import Localizer
from slam_toolbox_py.loop_closure import close_loops
from slam_toolbox_py.mapper import Mapper, Placement
from slam_toolbox_py.occupancy import Grid, MapDrawing
from slam_toolbox_py.poses import compose, FloatArray
from slam_toolbox_py.scans import Scan
from slam_toolbox_py.settings import MapperSettings
from slam_toolbox_py.storage import load_pose_graph, save_pose_graph

__all__ = ['Session', 'SessionSettings']

_FASTEST_M_S = 3.0
_JUMP_M = 1.0
_BACK_S = 0.5
_DRAWN_AT_ONCE = 40


@dataclass(frozen=True)
class SessionSettings:
    """The settings of scan processing and map drawing."""

    mapper: MapperSettings = field(default_factory=MapperSettings)
    minimum_time_interval_s: float = 0.5
    enough_travel: float = 1.0
    """The fraction of the minimum travel that makes a keyframe."""
    resolution_m: float = 0.05
    min_pass_through: int = 2
    occupancy_threshold: float = 0.1


class Session:
    """
    Scheduler that processes scans when they are due, and runs longer work in steps.

    Parameters
    ----------
    settings
        See `SessionSettings`; may be replaced with `change`.
    log
        Called with messages for the user.

    """

    def __init__(self, settings: SessionSettings, log: Callable[[str], None]) -> None:
        self.settings, self._log = settings, log
        self.mapper = Mapper(settings.mapper)
        self.localizer: Localizer | None = None
        self._drawing = MapDrawing(settings.resolution_m)
        self._jobs: deque[Iterator[str]] = deque()
        self._is_drawing = False
        self._last: tuple[float, FloatArray] | None = None
        self._processed_s = -np.inf
        self._began: FloatArray = np.zeros(3)

    def change(self, settings: SessionSettings) -> None:
        """
        Replace the settings.

        Parameters
        ----------
        settings
            The new settings; another resolution restarts the drawing of the map.

        """
        if settings.resolution_m != self.settings.resolution_m:
            self._drawing = MapDrawing(settings.resolution_m)
        self.settings = settings
        self.mapper.settings = settings.mapper

    @property
    def map_to_odom(self) -> FloatArray | None:
        """Return the (3,) pose of the odometry frame in the map; None before the first scan."""
        if self._processed_s == -np.inf:
            return None
        placed = self.mapper if self.localizer is None else self.localizer
        return placed.map_to_odom

    def reset(self) -> None:
        """Discard the map."""
        self.begin(Mapper(self.settings.mapper))

    def begin(self, mapper: Mapper, localizer: Localizer | None = None) -> None:
        """
        Replace the map, and drop the remaining work for the old one.

        Parameters
        ----------
        mapper
            The new map.
        localizer
            The localizer in the map; None to continue mapping.

        """
        self.mapper, self.localizer = mapper, localizer
        self._drawing = MapDrawing(self.settings.resolution_m)
        self._jobs.clear()
        self._is_drawing, self._last, self._processed_s = False, None, -np.inf

    def load(self, name: str, start: FloatArray | None, only_localize: bool) -> None:
        """
        Load a map from a file and continue with it.

        Parameters
        ----------
        name
            The file's path without extension.
        start
            (3,) pose of the robot in that map; None if it is at the origin of that map.
        only_localize
            Whether to leave the map unchanged.

        Raises
        ------
        PoseGraphFileError
            The file cannot be read; the session is left unchanged.

        """
        mapper = load_pose_graph(name, self.settings.mapper)
        pose = mapper.graph.poses[0] if start is None else np.asarray(start, dtype=float)
        if only_localize:
            self.begin(mapper, Localizer(mapper, pose))
        else:
            mapper.start_at(pose)
            self.begin(mapper)

    def save(self, name: str) -> Path:
        """
        Write the map to a file.

        Parameters
        ----------
        name
            The path without extension; `map` if it is empty.

        Returns
        -------
        Path
            The absolute path of the file.

        Raises
        ------
        OSError
            It cannot be written.

        """
        return save_pose_graph(self.mapper, name)

    def process(
        self, odometry: FloatArray, stamp_s: float, take: Callable[[], Scan]
    ) -> Placement | None:
        """
        Match a scan if it is due.

        Parameters
        ----------
        odometry, stamp_s
            (3,) pose of the base in the odometry frame when it was taken, and that time.
        take
            Returns the scan.

        Returns
        -------
        The placement of the scan; None if it was not due.

        """
        self._notice_jumps(odometry, stamp_s)
        self._last = stamp_s, odometry
        placed = self.mapper if self.localizer is None else self.localizer
        is_first = self._processed_s == -np.inf
        if not is_first and (
            stamp_s - self._processed_s < self.settings.minimum_time_interval_s
            or not placed.is_due(odometry, self.settings.enough_travel)
        ):
            return None
        scan = take()
        self._processed_s = stamp_s
        if self.localizer is not None:
            placement = self.localizer.add(scan, odometry)
        else:
            placement = self.mapper.add(scan, odometry, stamp_s)
            if self.settings.mapper.do_loop_closing:
                self._jobs.append(close_loops(self.mapper, len(self.mapper.keyframes) - 1))
        if is_first:
            self._began = placed.map_to_odom
        return placement

    def draw(self, then: Callable[[], None]) -> None:
        """
        Schedule the drawing of the map, in steps of `work`.

        Nothing happens if it is already being drawn, or if there are no keyframes.

        Parameters
        ----------
        then
            Called when the map is drawn.

        """
        if not self._is_drawing and self.mapper.keyframes:
            self._is_drawing = True
            self._jobs.append(self._drawn(then))

    def work(self, duration_s: float) -> None:
        """
        Run steps of loop closure and drawing for some time.

        Parameters
        ----------
        duration_s
            No step starts after this time, in s.

        """
        end_s = time.monotonic() + duration_s
        while self._jobs and time.monotonic() < end_s:
            try:
                told = next(self._jobs[0])
            except StopIteration:
                self._jobs.popleft()
                continue
            if told:
                self._log(told)

    def grid(self) -> Grid | None:
        """Return the current map, or the last drawn one if an update would take long."""
        if self._drawing.backlog(self.mapper) <= _DRAWN_AT_ONCE and not self._is_drawing:
            self._drawing.update(self.mapper)
        return self._drawing.grid(
            self.settings.min_pass_through, self.settings.occupancy_threshold
        )

    def _drawn(self, then: Callable[[], None]) -> Iterator[str]:
        for _ in self._drawing.drawing(self.mapper):
            yield ''
        self._is_drawing = False
        then()

    def _notice_jumps(self, odometry: FloatArray, stamp_s: float) -> None:
        """Relocalize the robot if time has jumped back or odometry has jumped."""
        if self._last is None or not self.mapper.keyframes:
            return
        before_s, before = self._last
        elapsed_s = stamp_s - before_s
        if elapsed_s < -_BACK_S:
            self._log(
                f'Time jumped back by {-elapsed_s:.1f} s. The map is kept; the robot is searched '
                'for at its odometry pose, as at the start. Call reset for a new map.'
            )
            self._processed_s = min(self._processed_s, stamp_s - 1e6)
            self._start_at(compose(self._began, odometry))
        elif np.hypot(*(odometry - before)[:2]) > _JUMP_M + _FASTEST_M_S * max(elapsed_s, 0.0):
            self._log(
                'Odometry jumped. The robot is searched for at its last pose in the map, and at '
                'its odometry pose. Call reset for a new map.'
            )
            self._processed_s = min(self._processed_s, stamp_s - 1e6)
            now = self.map_to_odom
            if now is not None:
                self._start_at(compose(now, before), compose(now, odometry))

    def _start_at(self, *poses: FloatArray) -> None:
        placed = self.mapper if self.localizer is None else self.localizer
        if not placed.is_searching:  # otherwise an initial pose was given
            placed.start_at(*poses)
