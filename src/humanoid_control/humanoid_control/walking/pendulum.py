# SPDX-License-Identifier: Apache-2.0
"""
Motion of the centre of mass: its model, its plan, its estimate and its reference.

The model is the linear inverted pendulum, the centre of mass at constant height above the
zero-moment point: S. Kajita et al., "The 3D linear inverted pendulum mode", IROS 2001, and the
divergent component of motion (DCM) of T. Takenaka et al., IROS 2009 (the capture point): with
c'' = w^2 (c - p) the point xi = c + c'/w diverges from p as exp(w t), while c converges to xi by
itself.

The plan is the DCM for a planned ZMP trajectory, in closed form: J. Englsberger, C. Ott,
A. Albu-Schaeffer, "Three-dimensional bipedal walking control based on divergent component of
motion", IEEE Transactions on Robotics 31(2), 2015: the DCM is unstable forwards in time and
therefore computed backwards, from the point where the robot comes to rest.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math

from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.planar import Point

GRAVITY_M_S2 = 9.81


@dataclass(frozen=True)
class Motion:
    """Horizontal position and velocity of the centre of mass."""

    position_m: Point = 0j
    velocity_m_s: Point = 0j


@dataclass(frozen=True)
class Pendulum:
    """Linear inverted pendulum of constant height."""

    height_m: float

    @property
    def rate_1_s(self) -> float:
        """Return w = sqrt(g / h), the rate at which the pendulum diverges."""
        return math.sqrt(GRAVITY_M_S2 / self.height_m)

    def dcm(self, motion: Motion) -> Point:
        """
        Compute the divergent component of motion (DCM, or capture point).

        Parameters
        ----------
        motion
            Position and velocity of the centre of mass over the ground.

        Returns
        -------
        Point
            In m, in the plane and the frame of the motion.

        """
        return motion.position_m + motion.velocity_m_s / self.rate_1_s

    def after(self, motion: Motion, zmp: Point, time_s: float) -> Motion:
        """
        Predict the motion of the centre of mass over a constant zero-moment point.

        The solution is exact, for any time.

        Parameters
        ----------
        motion
            Position and velocity of the centre of mass now.
        zmp
            The zero-moment point, in the frame of the motion (m).
        time_s
            How far ahead to predict.

        """
        rate = self.rate_1_s
        cosh, sinh = math.cosh(rate * time_s), math.sinh(rate * time_s)
        lean = motion.position_m - zmp
        return Motion(
            zmp + lean * cosh + motion.velocity_m_s * (sinh / rate),
            lean * (rate * sinh) + motion.velocity_m_s * cosh,
        )

    def acceleration_m_s2(self, position: Point, zmp: Point) -> Point:
        """
        Compute the horizontal acceleration of the centre of mass over a zero-moment point.

        Parameters
        ----------
        position, zmp
            The centre of mass and the zero-moment point in the ground plane (m).

        Returns
        -------
        Point
            The acceleration in m/s2, in the same axes.

        """
        return (position - zmp) * (GRAVITY_M_S2 / self.height_m)


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
            raise WalkingError('A ZMP trajectory needs at least one segment.')
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


@dataclass
class ComObserver:
    """
    Observer of the centre of mass with a linear inverted pendulum model.

    It predicts with the commanded zero-moment point, exactly over any time, and then corrects a
    fraction of the difference from the measurement that depends on the time passed.
    """

    pendulum: Pendulum
    rate_1_s: float
    motion: Motion | None = None

    def update(self, measured: Motion, zmp: Point, passed_s: float) -> Motion:
        """
        Predict the motion of the centre of mass, and correct it with the measured one.

        Parameters
        ----------
        measured
            Motion of the centre of mass by leg odometry, in the odom frame.
        zmp
            Zero-moment point (m) that was commanded since the last call, in the odom frame.
        passed_s
            Time since the last call.

        Returns
        -------
        Motion
            Estimated motion in the odom frame; the first call returns `measured`.

        """
        if self.motion is None:
            self.motion = measured
            return measured
        predicted = self.pendulum.after(self.motion, zmp, passed_s)
        self.motion = blended(predicted, measured, 1.0 - math.exp(-self.rate_1_s * passed_s))
        return self.motion


def blended(a: Motion, b: Motion, share: float) -> Motion:
    """
    Interpolate linearly between two motions of the centre of mass.

    Parameters
    ----------
    a, b
        The two motions, in the same frame.
    share
        Interpolation factor, from `a` (0) to `b` (1).

    """
    return Motion(
        a.position_m + share * (b.position_m - a.position_m),
        a.velocity_m_s + share * (b.velocity_m_s - a.velocity_m_s),
    )


@dataclass
class ComReference:
    """
    Reference motion of the centre of mass: a pendulum over the commanded zero-moment point.

    It leaks to the measured motion: without that, the integrated motion would diverge from the
    robot.
    """

    pendulum: Pendulum
    leak_1_s: float
    most_distance_m: float
    motion: Motion | None = None

    def update(self, measured: Motion, zmp: Point, passed_s: float) -> Motion:
        """
        Advance the reference motion of the centre of mass by one control period.

        It starts at rest at the estimated position, and stays within `most_distance_m` of it along
        each axis of the odom frame.

        Parameters
        ----------
        measured
            Estimated motion of the centre of mass, in the odom frame.
        zmp
            Commanded zero-moment point (m), in the odom frame.
        passed_s
            Time since the last call.

        Returns
        -------
        Motion
            Reference position in m and velocity in m/s, in the odom frame.

        """
        if self.motion is None:
            self.motion = Motion(measured.position_m)
        driven = self.pendulum.after(self.motion, zmp, passed_s)
        leaked = blended(driven, measured, 1.0 - math.exp(-self.leak_1_s * passed_s))
        lead = leaked.position_m - measured.position_m
        limited = measured.position_m + complex(self._limited(lead.real), self._limited(lead.imag))
        self.motion = Motion(limited, leaked.velocity_m_s)
        return self.motion

    def _limited(self, distance_m: float) -> float:
        """Clamp a distance from the estimate to `most_distance_m`."""
        return max(-self.most_distance_m, min(self.most_distance_m, distance_m))
