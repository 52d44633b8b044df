# SPDX-License-Identifier: Apache-2.0
"""Spline interpolation of several joints through points, such as those of a trajectory."""

from __future__ import annotations

from humanoid_control.backends import Array, JointTargets
from humanoid_control.controllers.trajectory import Trajectory
import numpy as np


class Spline:
    """
    Piecewise polynomial through points: cubic, or quintic if accelerations are given.

    Parameters
    ----------
    times_s
        Times of the k points (k,), strictly increasing; at least two.
    positions
        Positions of the m joints at each point (k, m), in any unit.
    velocities, accelerations
        Derivatives at the points (k, m), in that unit per s and s2; without accelerations the
        polynomials are cubic.

    """

    def __init__(
        self, times_s: Array, positions: Array, velocities: Array, accelerations: Array | None
    ) -> None:
        self._times_s = times_s
        self._steps_s = np.diff(times_s)
        steps_s = self._steps_s[:, None]
        p0, p1 = positions[:-1], positions[1:]
        v0, v1 = velocities[:-1] * steps_s, velocities[1:] * steps_s
        if accelerations is None:
            self._coefficients = cubic(p0, p1, v0, v1)
        else:
            a0, a1 = accelerations[:-1] * steps_s**2, accelerations[1:] * steps_s**2
            self._coefficients = quintic(p0, p1, v0, v1, a0, a1)

    @property
    def end_s(self) -> float:
        """Return the time of the last point."""
        return float(self._times_s[-1])

    def at(self, time_s: float) -> tuple[Array, Array]:
        """
        Evaluate the spline at a time.

        Parameters
        ----------
        time_s
            Time on the axis of the points; clamped to the range from the first to the last one.

        Returns
        -------
        tuple[Array, Array]
            Positions and velocities of the joints, (m,) each; the latter in units of the positions
            per s.

        """
        time_s = min(max(time_s, float(self._times_s[0])), self.end_s)
        last = len(self._steps_s) - 1
        piece = min(int(np.searchsorted(self._times_s, time_s, side='right')) - 1, last)
        step_s = self._steps_s[piece]
        powers = ((time_s - self._times_s[piece]) / step_s) ** np.arange(6)
        slopes = np.arange(1, 6) * powers[:-1] / step_s
        coefficients = self._coefficients[:, piece]
        return powers @ coefficients, slopes @ coefficients[1:]


def cubic(p0: Array, p1: Array, v0: Array, v1: Array) -> Array:
    """
    Compute the coefficients of cubic polynomials between two points, over a time from 0 to 1.

    Parameters
    ----------
    p0, p1
        Positions at the start and at the end, of any shape, such as (segments, joints).
    v0, v1
        Velocities there, multiplied by the duration of the segment.

    Returns
    -------
    Array
        Six coefficients along a new first axis, the constant first; the last two are zero.

    """
    way, none = p1 - p0, np.zeros_like(p0)
    return np.stack([p0, v0, 3 * way - 2 * v0 - v1, v0 + v1 - 2 * way, none, none])


def quintic(p0: Array, p1: Array, v0: Array, v1: Array, a0: Array, a1: Array) -> Array:
    """
    Compute the coefficients of quintic polynomials between two points, over a time from 0 to 1.

    Parameters
    ----------
    p0, p1
        Positions at the start and at the end, of any shape, such as (segments, joints).
    v0, v1
        Velocities there, multiplied by the duration of the segment.
    a0, a1
        Accelerations there, multiplied by the square of the duration.

    Returns
    -------
    Array
        Six coefficients along a new first axis, the constant first.

    """
    way = p1 - p0
    return np.stack(
        [
            p0,
            v0,
            a0 / 2,
            10 * way - 6 * v0 - 4 * v1 - (3 * a0 - a1) / 2,
            -15 * way + 8 * v0 + 7 * v1 + (3 * a0 - 2 * a1) / 2,
            6 * way - 3 * (v0 + v1) - (a0 - a1) / 2,
        ]
    )


def inner_velocities(times_s: Array, positions: Array) -> Array:
    """
    Choose velocities at points without any: zero at both ends and where a joint reverses.

    Elsewhere it is the harmonic mean of the adjacent slopes, which makes the cubic spline monotone
    between points, without overshoot (Fritsch and Butland, 1984).

    Parameters
    ----------
    times_s
        Times of the k points (k,), strictly increasing.
    positions
        Positions of the m joints at each point (k, m).

    Returns
    -------
    Array
        Velocities (k, m), in units of the positions per s.

    """
    speeds = np.diff(positions, axis=0) / np.diff(times_s)[:, None]
    before, after = speeds[:-1], speeds[1:]
    onwards = before * after > 0.0
    sum_of = np.where(onwards, before + after, 1.0)
    velocities = np.zeros_like(positions)
    velocities[1:-1] = np.where(onwards, 2.0 * before * after / sum_of, 0.0)
    return velocities


def spline_from(trajectory: Trajectory, held: JointTargets) -> Spline:
    """
    Build the spline from the last targets of joints through the points of a trajectory.

    Parameters
    ----------
    trajectory
        Trajectory of m joints; its times count from now.
    held
        Last targets of all joints of the robot. The spline starts at their positions and
        velocities, unless the trajectory has a point at time zero or before.

    Returns
    -------
    Spline
        Spline of the m joints; it ends at rest if the points have no velocities.

    """
    times_s, positions_rad = trajectory.times_s, trajectory.positions_rad
    velocities_rad_s, accelerations = trajectory.velocities_rad_s, trajectory.accelerations_rad_s2
    begins = times_s[0] > 0.0
    if begins:
        times_s = np.concatenate(([0.0], times_s))
        positions_rad = _led_by(held.positions_rad[trajectory.indices], positions_rad)
    if velocities_rad_s is None:
        velocities_rad_s = inner_velocities(times_s, positions_rad)
        if begins:
            velocities_rad_s[0] = held.velocities_rad_s[trajectory.indices]
    elif begins:
        velocities_rad_s = _led_by(held.velocities_rad_s[trajectory.indices], velocities_rad_s)
    if accelerations is not None and begins:
        accelerations = _led_by(np.zeros_like(accelerations[0]), accelerations)
    return Spline(times_s, positions_rad, velocities_rad_s, accelerations)


def _led_by(first: Array, rows: Array) -> Array:
    """Prepend a row."""
    return np.vstack([first, rows])
