# SPDX-License-Identifier: Apache-2.0
"""The ideal robot of the loopback simulator: follows commands exactly, and scans the map."""

from __future__ import annotations

from dataclasses import dataclass
import math

from nav2_amcl.occupancy_map import FloatArray, OccupancyMap, RayCaster
from nav2_util.geometry import Pose2D
from nav2_util.twist import Velocity
import numpy as np

__all__ = ['LaserShape', 'LoopbackRobot', 'SimulatedLaser']

_STRAIGHT_RAD = 1e-6

_BELOW_MAXIMUM_M = 0.1


class LoopbackRobot:
    """
    Ideal omnidirectional robot.

    It moves once it was placed in the map. A command is held for `timeout_s` of the time that
    `step` simulates; then the robot stops.

    Parameters
    ----------
    timeout_s
        The timeout of commands.

    """

    def __init__(self, timeout_s: float = 1.0) -> None:
        self.odom = Pose2D(0.0, 0.0, 0.0)
        """The base in the frame of odometry."""
        self.map_to_odom: Pose2D | None = None
        """Odometry in the frame of the map, once the robot was placed."""
        self._timeout_s = timeout_s
        self._command = Velocity()
        self._left_s = 0.0

    @property
    def velocity(self) -> Velocity:
        """Return the velocity of the base in its own frame."""
        return self._command if self._left_s > 0.0 else Velocity()

    @property
    def pose_in_map(self) -> Pose2D | None:
        """The base in the map, once it was placed."""
        return None if self.map_to_odom is None else self.map_to_odom @ self.odom

    def place(self, pose: Pose2D) -> None:
        """
        Place the robot at a pose in the map.

        Only the transform from map to odom changes: odometry is continuous, as if the robot were
        carried.

        Parameters
        ----------
        pose
            The base in the map frame (m, rad).

        """
        self.map_to_odom = pose @ self.odom.inverse()

    def command(self, velocity: Velocity) -> None:
        """
        Set the velocity command; it is ignored until the robot was placed.

        Parameters
        ----------
        velocity
            The velocity in the base frame (m/s, rad/s), which is held for `timeout_s` of the
            class.

        """
        if self.map_to_odom is not None:
            self._command, self._left_s = velocity, self._timeout_s

    def step(self, duration_s: float) -> None:
        """
        Advance the robot by a time step, along the arc of its velocity.

        Parameters
        ----------
        duration_s
            The time step in s, also counted against the timeout of the command.

        """
        velocity = self.velocity
        self._left_s = max(self._left_s - duration_s, 0.0)
        if not velocity.is_zero:
            self.odom = self.odom @ _arc(velocity, duration_s)


def _arc(velocity: Velocity, duration_s: float) -> Pose2D:
    """Compute the motion at constant velocity, in the frame at its start."""
    turn = velocity.yaw * duration_s
    x, y = velocity.x * duration_s, velocity.y * duration_s
    if abs(turn) < _STRAIGHT_RAD:
        return Pose2D(x, y, turn)
    ahead, aside = math.sin(turn) / turn, (1.0 - math.cos(turn)) / turn
    return Pose2D(ahead * x - aside * y, aside * x + ahead * y, turn)


@dataclass(frozen=True)
class LaserShape:
    """Beam angles of a scanner in rad, and its range limits in m."""

    angle_min_rad: float
    angle_max_rad: float
    angle_increment_rad: float
    range_min_m: float
    range_max_m: float
    uses_inf: bool = True

    @property
    def count(self) -> int:
        """The number of beams."""
        span = self.angle_max_rad - self.angle_min_rad
        return max(int(span / self.angle_increment_rad + 1e-6) + 1, 1)


class SimulatedLaser:
    """
    Noiseless laser scanner that detects the occupied cells of a map, once there is one.

    Parameters
    ----------
    shape
        The beams.

    """

    def __init__(self, shape: LaserShape) -> None:
        self.shape = shape
        steps = np.arange(shape.count, dtype=np.float64)
        self._angles: FloatArray = shape.angle_min_rad + steps * shape.angle_increment_rad
        self._caster: RayCaster | None = None

    @property
    def has_map(self) -> bool:
        """Whether a map is set."""
        return self._caster is not None

    def set_map(self, grid: OccupancyMap) -> None:
        """
        Set the map whose occupied cells the beams hit.

        Parameters
        ----------
        grid
            The map; its frame is that of the poses given to `scan`.

        """
        self._caster = RayCaster(grid)

    def scan(self, pose: Pose2D | None) -> FloatArray:
        """
        Compute the ranges of a scan.

        Parameters
        ----------
        pose
            The pose of the laser in the map; None if unknown.

        Returns
        -------
        (B,) array of ranges in m, at least the minimum; without a hit, inf or 0.1 m below the
        maximum.

        """
        if self._caster is None or pose is None:
            ranges = np.full(len(self._angles), np.inf)
        else:
            origin = np.array([[pose.x, pose.y]])
            ranges = self._caster.cast(origin, pose.yaw + self._angles, self.shape.range_max_m)
        seen = np.maximum(ranges, self.shape.range_min_m)
        nothing = np.inf if self.shape.uses_inf else self.shape.range_max_m - _BELOW_MAXIMUM_M
        return np.where(np.isfinite(ranges), seen, nothing)
