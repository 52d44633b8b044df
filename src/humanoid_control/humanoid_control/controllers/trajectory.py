# SPDX-License-Identifier: Apache-2.0
"""Joint trajectories, and their validation against the joint limits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from humanoid_control.backends import Array, JointLimits
from humanoid_control.controllers.commands import (
    checked_values,
    CommandError,
    Indices,
    JointNames,
)
import numpy as np
from numpy.typing import NDArray

MOST_POINTS = 1000
"""More points would delay the robot's next tick for too long."""


@dataclass(frozen=True)
class TrajectoryPoint:
    """Joint positions at a time after the start; velocities and accelerations are optional."""

    time_s: float
    positions_rad: Sequence[float]
    velocities_rad_s: Sequence[float] = ()
    accelerations_rad_s2: Sequence[float] = ()


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Validated trajectory of m joints through k points; a field that no point gives is None."""

    indices: Indices
    times_s: Array
    """(k,)"""
    positions_rad: Array
    """(k, m)"""
    velocities_rad_s: Array | None
    accelerations_rad_s2: Array | None


def checked_trajectory(
    joints: JointNames,
    limits: JointLimits,
    names: Sequence[str],
    points: Sequence[TrajectoryPoint],
) -> Trajectory:
    """
    Validate a joint trajectory: joint names, times, values and joint limits.

    Neither accelerations nor the motion from the current positions to the first point are limited
    here.

    Parameters
    ----------
    joints, limits
        All joints of the robot, and their limits, in the same order.
    names
        The m joints that the trajectory moves, in the order of the values of its points.
    points
        The k points, at increasing times.

    Returns
    -------
    Trajectory
        Its columns are in the order of `names`.

    Raises
    ------
    CommandError
        The first reason why it is rejected: names, number or times of points, values, or a
        position or velocity beyond the limits.

    """
    indices = joints.indices(names)
    if not points:
        raise CommandError('It has no points. Give at least one.')
    if len(points) > MOST_POINTS:
        raise CommandError(f'It has {len(points)} points. Give at most {MOST_POINTS}.')
    times_s = _checked_times(points)
    positions_rad = _checked_rows('position', [point.positions_rad for point in points], names)
    _check_range(positions_rad, indices, limits, names)
    _check_speed(times_s, positions_rad, indices, limits, names)
    velocities_rad_s = _given('velocity', [point.velocities_rad_s for point in points], names)
    if velocities_rad_s is not None:
        _check_velocities(velocities_rad_s, limits.velocity_rad_s[indices], names)
    return Trajectory(
        indices,
        times_s,
        positions_rad,
        velocities_rad_s,
        _given('acceleration', [point.accelerations_rad_s2 for point in points], names),
    )


def _checked_times(points: Sequence[TrajectoryPoint]) -> Array:
    """Collect the times of the points; they must start at 0 s or later, and increase."""
    times_s = np.array([point.time_s for point in points])
    if times_s[0] < 0.0:
        raise CommandError(f'Its first point is at {times_s[0]:g} s. Start at 0 s or later.')
    if len(times_s) == 1 and times_s[0] == 0.0:
        raise CommandError('Its only point is at 0 s, which is a jump. Give it a later time.')
    backwards = np.flatnonzero(np.diff(times_s) <= 0.0)
    if len(backwards):
        first = int(backwards[0])
        raise CommandError(
            f'Point {first + 2} is at {times_s[first + 1]:g} s, not after the previous one, '
            f'at {times_s[first]:g} s. Times must increase.'
        )
    return times_s


def _checked_rows(field: str, rows: Sequence[Sequence[float]], names: Sequence[str]) -> Array:
    """Collect the values of a field, (k, m); reject missing or non-finite ones."""
    for row in rows:
        if len(row) != len(names):
            checked_values(field, row, names)
    values = np.array(rows, dtype=np.float64)
    bad = _first(~np.isfinite(values))
    if bad is not None:
        checked_values(field, rows[bad[0]], names)
    return values


def _check_range(
    positions_rad: Array, indices: Indices, limits: JointLimits, names: Sequence[str]
) -> None:
    """Validate joint positions against the limits."""
    lower, upper = limits.lower_rad[indices], limits.upper_rad[indices]
    outside = _first((positions_rad < lower) | (positions_rad > upper))
    if outside is not None:
        point, joint = outside
        raise CommandError(
            f"Point {point + 1} has '{names[joint]}' at {positions_rad[outside]:g} rad, out of "
            f'its range of {lower[joint]:g} to {upper[joint]:g} rad.'
        )


def _check_speed(
    times_s: Array,
    positions_rad: Array,
    indices: Indices,
    limits: JointLimits,
    names: Sequence[str],
) -> None:
    """Validate the mean velocities between points against the velocity limits."""
    fastest_rad_s = limits.velocity_rad_s[indices]
    speeds_rad_s = np.abs(np.diff(positions_rad, axis=0)) / np.diff(times_s)[:, None]
    too_fast = _first(speeds_rad_s > fastest_rad_s)
    if too_fast is not None:
        point, joint = too_fast
        raise CommandError(
            f"'{names[joint]}' would have to move at {speeds_rad_s[too_fast]:.3g} rad/s to be at "
            f'point {point + 2} in time, but can do {fastest_rad_s[joint]:.3g} rad/s. '
            'Give it more time.'
        )


def _check_velocities(velocities_rad_s: Array, most_rad_s: Array, names: Sequence[str]) -> None:
    """Validate the velocities at the points against the velocity limits."""
    for number, speed_rad_s in enumerate(np.abs(velocities_rad_s), start=1):
        too_fast = speed_rad_s > most_rad_s
        if too_fast.any():
            joint = int(np.argmax(too_fast))
            raise CommandError(
                f"Point {number} moves '{names[joint]}' at {speed_rad_s[joint]:.3g} rad/s, "
                f'but it can do {most_rad_s[joint]:.3g} rad/s. Give less, or leave out velocities.'
            )


def _given(field: str, rows: Sequence[Sequence[float]], names: Sequence[str]) -> Array | None:
    """Collect an optional field of the points, zero where it is empty; None if no point has it."""
    if not any(len(row) for row in rows):
        return None
    nothing = [0.0] * len(names)
    return _checked_rows(field, [row if len(row) else nothing for row in rows], names)


def _first(true: NDArray[np.bool_]) -> tuple[int, int] | None:
    """Return row and column of the first element that is true, None if there is none."""
    found = np.argwhere(true)
    return (int(found[0, 0]), int(found[0, 1])) if len(found) else None
