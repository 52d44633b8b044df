# SPDX-License-Identifier: Apache-2.0
"""Localize in a finished map: scans are matched to its keyframes, and none is added."""

from __future__ import annotations

import numpy as np
from slam_toolbox_py.mapper import (
    find_again,
    has_moved,
    Mapper,
    Placement,
    placement_of,
    trust_in_odometry,
)
from slam_toolbox_py.matching import correlate, refine, RefinedMatch, Surfaces
from slam_toolbox_py.poses import compose, FloatArray, inverse, relative
from slam_toolbox_py.scans import Scan

__all__ = ['Localizer']


class Localizer:
    """
    Tracks the pose of a robot in a map.

    Parameters
    ----------
    mapper
        The map, which is not changed.
    start
        (3,) approximate pose of the robot.

    """

    def __init__(self, mapper: Mapper, start: FloatArray) -> None:
        self._mapper = mapper
        self._pose = np.asarray(start, dtype=float)
        self._starts: list[FloatArray] = [self._pose]
        self._odometry: FloatArray | None = None
        self._seen: tuple[tuple[int, ...], Surfaces] = ((), Surfaces([]))
        self.map_to_odom: FloatArray = np.zeros(3)
        """(3,) pose of the odometry frame in the map."""

    def start_at(self, *poses: FloatArray) -> None:
        """
        Search for the robot near given poses with the next scan.

        Parameters
        ----------
        *poses
            Poses (3,) of the base in the map.

        """
        self._starts = [np.asarray(pose, dtype=float) for pose in poses]

    @property
    def is_searching(self) -> bool:
        """Whether the next scan is searched for near given poses."""
        return bool(self._starts)

    def is_due(self, odometry: FloatArray, share: float = 1.0) -> bool:
        """
        Check whether the robot has moved enough to match a scan.

        Parameters
        ----------
        odometry
            Pose (3,) of the base in the odometry frame.
        share
            The fraction of the minimum travel that is sufficient.

        """
        if self._starts or self._odometry is None:
            return True
        return has_moved(self._odometry, odometry, self._mapper.settings, share)

    def add(self, scan: Scan, odometry: FloatArray) -> Placement:
        """
        Match a scan to the map, and correct `map_to_odom`.

        Parameters
        ----------
        scan
            The scan.
        odometry
            Pose (3,) of the base in the odometry frame at that time.

        Returns
        -------
        Placement
            Pose of the base in the map, with covariance; predicted by odometry if the match is
            poor.

        """
        settings = self._mapper.settings
        if self._starts or self._odometry is None:
            match, _ = find_again(self._mapper, scan, self._starts)
        else:
            moved = relative(self._odometry, odometry)
            guess, trust = compose(self._pose, moved), trust_in_odometry(moved)
            seen = self._surfaces(guess)
            start = correlate(seen.points, scan.points, guess, settings.local_search())
            match = refine(seen, scan, start.pose, guess, trust)
            if match.response < settings.link_match_minimum_response_fine:
                match = RefinedMatch(guess, trust, match.response)
        self._starts, self._pose = [], match.pose
        self._odometry = np.array(odometry, dtype=float)
        self.map_to_odom = compose(match.pose, inverse(self._odometry))
        return placement_of(match)

    def _surfaces(self, pose: FloatArray) -> Surfaces:
        """Return the surfaces near a pose; cached while the same keyframes are near."""
        near = tuple(sorted(self._mapper.nearest(pose[:2])))
        if near != self._seen[0]:
            self._seen = near, self._mapper.surfaces(list(near))
        return self._seen[1]
