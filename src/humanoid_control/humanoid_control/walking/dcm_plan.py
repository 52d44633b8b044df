# SPDX-License-Identifier: Apache-2.0
"""
Divergent component of motion (DCM) for a planned ZMP trajectory, in closed form.

J. Englsberger, C. Ott, A. Albu-Schaeffer, "Three-dimensional bipedal walking control based on
divergent component of motion", IEEE Transactions on Robotics 31(2), 2015: the DCM is unstable
forwards in time and therefore computed backwards, from the point where the robot comes to rest.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math

from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.planar import Point


@dataclass(frozen=True)
class ZmpSegment:
    """Segment of a ZMP trajectory: uniform motion along a line."""

    duration_s: float
    start_m: Point
    end_m: Point


@dataclass(frozen=True)
class BalanceReference:
    """Reference of the divergent component of motion and the zero-moment point at a time."""

    dcm_m: Point
    zmp_m: Point


class DcmPlan:
    """
    ZMP trajectory, and the DCM trajectory that belongs to it and rests at its end.

    Parameters
    ----------
    segments
        The ZMP trajectory, each segment of a positive duration; the robot rests at its end.
    rate_1_s
        The rate sqrt(g / h) of a pendulum as high as the centre of mass.

    Raises
    ------
    WalkingError
        There are no segments.

    """

    def __init__(self, segments: Sequence[ZmpSegment], rate_1_s: float) -> None:
        if not segments:
            raise WalkingError('A plan of the zero-moment point needs at least one segment.')
        self._rate_1_s = rate_1_s
        self._segments = tuple(segments)
        self._dcm_at_end = [self._segments[-1].end_m]
        for segment in self._segments[:0:-1]:
            self._dcm_at_end.append(self._dcm(segment, 0.0, self._dcm_at_end[-1]))
        self._dcm_at_end.reverse()

    @property
    def segments(self) -> tuple[ZmpSegment, ...]:
        """Return the segments of the ZMP trajectory."""
        return self._segments

    @property
    def duration_s(self) -> float:
        """Return the time until the robot is at rest."""
        return sum(segment.duration_s for segment in self._segments)

    def at(self, time_s: float) -> BalanceReference:
        """
        Evaluate the DCM and ZMP trajectories at a time.

        Parameters
        ----------
        time_s
            Time since the start of the plan; outside its duration the first or last point holds.

        Returns
        -------
        BalanceReference
            Divergent component of motion and zero-moment point in m, in the frame of the segments.

        """
        time_s = max(0.0, time_s)
        for segment, dcm_at_end in zip(self._segments, self._dcm_at_end):
            if time_s < segment.duration_s:
                way = segment.end_m - segment.start_m
                zmp = segment.start_m + way * (time_s / segment.duration_s)
                return BalanceReference(self._dcm(segment, time_s, dcm_at_end), zmp)
            time_s -= segment.duration_s
        return BalanceReference(self._segments[-1].end_m, self._segments[-1].end_m)

    def _dcm(self, segment: ZmpSegment, time_s: float, dcm_at_end: Point) -> Point:
        """Compute the DCM at a time within a segment."""
        speed = (segment.end_m - segment.start_m) / segment.duration_s
        ahead = speed / self._rate_1_s
        decay = math.exp(-self._rate_1_s * (segment.duration_s - time_s))
        zmp = segment.start_m + speed * time_s
        return zmp + ahead + (dcm_at_end - segment.end_m - ahead) * decay
