# SPDX-License-Identifier: Apache-2.0
"""Smooth a velocity towards its command within limits of speed and acceleration."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

__all__ = ['Limits', 'OdometryAverage', 'apply_deadband', 'smooth']

FloatArray = npt.NDArray[np.float64]
_AXES = 'x, y and theta'


@dataclass(frozen=True)
class Limits:
    """
    Velocity limits, each an array of x, y (m/s, m/s^2) and theta (rad/s, rad/s^2).

    Use `Limits.checked`, which validates user input.
    """

    max_velocity: FloatArray
    min_velocity: FloatArray
    max_accel: FloatArray
    max_decel: FloatArray
    deadband_velocity: FloatArray
    scale_velocities: bool = False

    @classmethod
    def checked(
        cls,
        max_velocity: Sequence[float],
        min_velocity: Sequence[float],
        max_accel: Sequence[float],
        max_decel: Sequence[float],
        deadband_velocity: Sequence[float],
        scale_velocities: bool = False,
    ) -> Limits:
        """
        Validate and make limits from lists of three numbers.

        Parameters
        ----------
        max_velocity, min_velocity
            The maximum velocities forwards and, negative, backwards.
        max_accel, max_decel
            The maximum acceleration and, negative, deceleration.
        deadband_velocity
            The speeds below which the robot's hardware does not move; they are set to zero.
        scale_velocities
            Whether the limit of one axis scales the others with it.

        Raises
        ------
        ValueError
            A list does not have three finite numbers, or one has the wrong sign.

        """
        return cls(
            _vector('max_velocity', max_velocity, 1, 'the greatest velocity forwards'),
            _vector('min_velocity', min_velocity, -1, 'the greatest velocity backwards'),
            _vector('max_accel', max_accel, 1, 'how fast the speed may grow'),
            _vector('max_decel', max_decel, -1, 'how fast the speed may shrink'),
            _vector('deadband_velocity', deadband_velocity, 1, 'the least speed that moves'),
            scale_velocities,
        )


def smooth(
    command: FloatArray, current: FloatArray, limits: Limits, period_s: float
) -> FloatArray:
    """
    Compute the velocity nearest to a command within the limits, after one period.

    Parameters
    ----------
    command, current
        The commanded velocity and the current one: arrays of x, y (m/s) and theta (rad/s).
    limits
        An axis that speeds up in its direction is limited by `max_accel`, every other one by
        `max_decel`. With `scale_velocities`, the most limited axis scales the whole command, so
        that the robot stays on the commanded curve as far as the limits allow.
    period_s
        The control period.

    Returns
    -------
    numpy.ndarray
        The velocity of x, y and theta, before the deadband.

    """
    command = np.clip(command, limits.min_velocity, limits.max_velocity)
    grows = (np.abs(command) >= np.abs(current)) & (command * current >= 0.0)
    step = np.where(grows, limits.max_accel, -limits.max_decel) * period_s
    reached = current + np.clip(command - current, -step, step)
    if limits.scale_velocities:
        moves = command != 0.0
        ratios = reached[moves] / command[moves]
        if ratios.size:
            scaled = command * ratios[np.argmax(np.abs(1.0 - ratios))]
            reached = current + np.clip(scaled - current, -step, step)
    reached = np.clip(reached, limits.min_velocity, limits.max_velocity)
    return np.asarray(reached, dtype=np.float64)


def apply_deadband(velocity: FloatArray, limits: Limits) -> FloatArray:
    """
    Set the axes of a velocity within the deadband to zero.

    Parameters
    ----------
    velocity
        (3,) x, y (m/s) and theta (rad/s).
    limits
        The limits, of which `deadband_velocity` is used.

    Returns
    -------
    FloatArray
        (3,) x, y (m/s) and theta (rad/s).

    """
    return np.where(np.abs(velocity) < limits.deadband_velocity, 0.0, velocity)


class OdometryAverage:
    """
    Moving average of the velocity from odometry.

    Parameters
    ----------
    duration_s
        The length of the window.

    """

    def __init__(self, duration_s: float) -> None:
        self.duration_s = duration_s
        self._samples: deque[tuple[float, FloatArray]] = deque(maxlen=1000)

    def add(self, now_s: float, velocity: Sequence[float]) -> None:
        """
        Add a measured velocity; a non-finite one is ignored.

        Parameters
        ----------
        now_s
            The time in s; if it has jumped back, earlier velocities are dropped.
        velocity
            (3,) x, y (m/s) and theta (rad/s).

        """
        if np.all(np.isfinite(velocity)):
            if self._samples and self._samples[-1][0] > now_s:
                self._samples.clear()
            self._samples.append((now_s, np.asarray(velocity, dtype=np.float64)))

    def velocity(self, now_s: float, not_older_s: float) -> FloatArray | None:
        """
        Compute the average velocity over the window, always including the newest one.

        Parameters
        ----------
        now_s
            The time in s.
        not_older_s
            The maximum age of the newest velocity, in s.

        Returns
        -------
        FloatArray or None
            (3,) x, y (m/s) and theta (rad/s); None if the newest is too old, or there is none.

        """
        if not self._samples or now_s - self._samples[-1][0] > not_older_s:
            return None
        while len(self._samples) > 1 and self._samples[0][0] < now_s - self.duration_s:
            self._samples.popleft()
        return np.asarray(np.mean([each for _, each in self._samples], axis=0))


def _vector(name: str, values: Sequence[float], sign: int, meaning: str) -> FloatArray:
    if len(values) != 3:
        raise ValueError(
            f"The parameter '{name}' needs 3 numbers, for {_AXES}, but has {len(values)}."
        )
    vector = np.asarray(values, dtype=np.float64)
    if not np.all(np.isfinite(vector)):
        raise ValueError(f"The parameter '{name}' must be finite, but is {list(values)}.")
    if np.any(vector * sign < 0.0):
        wanted = 'negative' if sign < 0 else 'positive'
        raise ValueError(
            f"The numbers of the parameter '{name}' must be {wanted} or zero: it is "
            f'{meaning}. They are {list(values)}.'
        )
    return vector
