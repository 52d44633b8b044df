# SPDX-License-Identifier: Apache-2.0
"""Velocity of the robot, as the mean of recent odometry."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Any

from nav2_controller.control import Velocity
from nav2_util.odometry import subscribe_velocity

__all__ = ['OdometryMonitor']


class OdometryMonitor:
    """
    Moving average of the velocities from odometry.

    Parameters
    ----------
    node
        The node that subscribes.
    topic
        The topic of the odometry.
    duration_s
        The averaging window.
    now_s
        Function that returns the time in s.

    """

    def __init__(
        self, node: Any, topic: str, duration_s: float, now_s: Callable[[], float]
    ) -> None:
        self._duration_s, self._now_s = duration_s, now_s
        self._found: deque[tuple[float, Velocity]] = deque()
        self.topic = topic
        subscribe_velocity(node, topic, self._receive)

    def velocity(self, thresholds: Velocity = Velocity()) -> Velocity:
        """
        Compute the mean velocity over the window; 0 if none is known.

        Parameters
        ----------
        thresholds
            Components of the mean with a smaller magnitude count as 0 (m/s, m/s, rad/s).

        Returns
        -------
        Velocity
            In the base frame.

        """
        count = len(self._found)
        if not count:
            return Velocity()
        means = (sum(each[1][k] for each in self._found) / count for k in range(3))
        return Velocity(*(v if abs(v) >= low else 0.0 for v, low in zip(means, thresholds)))

    @property
    def age_s(self) -> float | None:
        """Return the time in s since the newest message; None before the first."""
        return self._now_s() - self._found[-1][0] if self._found else None

    def _receive(self, _: float, velocity: tuple[float, float, float]) -> None:
        now = self._now_s()
        if self._found and now < self._found[-1][0]:
            self._found.clear()
        self._found.append((now, Velocity(*velocity)))
        while now - self._found[0][0] > self._duration_s:
            self._found.popleft()
