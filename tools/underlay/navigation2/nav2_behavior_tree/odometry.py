# SPDX-License-Identifier: Apache-2.0
"""The velocity of the robot, averaged over a short time."""

from __future__ import annotations

from collections import deque

__all__ = ['OdometrySmoother']


class OdometrySmoother:
    """
    Moving average of the velocities of the last `duration_s`.

    Parameters
    ----------
    duration_s
        The length of the window in s.

    """

    def __init__(self, duration_s: float) -> None:
        self._duration_s = duration_s
        self._samples: deque[tuple[float, float, float]] = deque()

    def add(self, time_s: float, x_m_s: float, yaw_rad_s: float) -> None:
        """
        Add a sample; drop samples older than the duration, or all if time jumps back.

        Parameters
        ----------
        time_s
            The time of the measurement in s.
        x_m_s
            The forward velocity in m/s.
        yaw_rad_s
            The yaw rate in rad/s.

        """
        if self._samples and time_s < self._samples[-1][0]:
            self._samples.clear()
        self._samples.append((time_s, x_m_s, yaw_rad_s))
        while self._samples[0][0] < time_s - self._duration_s:
            self._samples.popleft()

    @property
    def velocity(self) -> tuple[float, float]:
        """Forward velocity in m/s and yaw rate in rad/s; 0 if no sample is available."""
        count = len(self._samples)
        if not count:
            return 0.0, 0.0
        return (
            sum(sample[1] for sample in self._samples) / count,
            sum(sample[2] for sample in self._samples) / count,
        )

    @property
    def acceleration_m_s2(self) -> float:
        """Return the mean forward acceleration over the same window."""
        if len(self._samples) < 2 or self._samples[-1][0] <= self._samples[0][0]:
            return 0.0
        first, last = self._samples[0], self._samples[-1]
        return (last[1] - first[1]) / (last[0] - first[0])
