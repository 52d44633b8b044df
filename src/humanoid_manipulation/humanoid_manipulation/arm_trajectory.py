# SPDX-License-Identifier: Apache-2.0
"""When an arm and the waist are where on a path: a trajectory with smooth ends and corners."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_description.robot import Array
from humanoid_manipulation.upper_body import Reach
import numpy as np

__all__ = ['ArmTrajectory', 'timed']

_PERIOD_S = 0.05
"""Time between the points of a motion."""
_SMOOTHING_S = 0.5
"""Window of the moving average that smooths the start, the end and the corners of a motion."""


@dataclass(frozen=True, eq=False)
class ArmTrajectory:
    """
    A trajectory of the waist and the six joints of an arm.

    Attributes
    ----------
    times_s
        The times of the n points (n,), starting at 0.
    positions_rad, velocities_rad_s
        The joint positions and velocities at each point (n, 7), the waist first.

    """

    times_s: Array
    positions_rad: Array
    velocities_rad_s: Array

    @property
    def duration_s(self) -> float:
        """Return the duration of the trajectory."""
        return float(self.times_s[-1])


def timed(way: list[Reach], velocity_rad_s: float) -> ArmTrajectory:
    """
    Time-parameterise a path with a velocity limit, and smooth its ends and corners.

    The path is traversed at constant speed, and then filtered with a Hann window. Therefore no
    joint exceeds the velocity limit, none accelerates by more than four times the limit divided by
    the window's length, and corners are rounded.

    Parameters
    ----------
    way
        The waypoints of the path.
    velocity_rad_s
        The velocity limit of the joints.

    """
    corners = np.array([each.positions_rad for each in way])
    lengths = np.abs(np.diff(corners, axis=0)).max(axis=1, initial=0.0)
    ends_s = np.concatenate(([0.0], np.cumsum(lengths / velocity_rad_s)))
    fine_s = _PERIOD_S / 10.0
    window = np.hanning(round(_SMOOTHING_S / fine_s) + 2)[1:-1]
    window /= window.sum()
    padding = len(window) // 2
    even_s = np.arange(math.ceil(ends_s[-1] / fine_s) + 1) * fine_s
    even = np.stack([np.interp(even_s, ends_s, column) for column in corners.T], axis=1)
    padded = np.concatenate(
        (np.repeat(even[:1], 2 * padding, 0), even, np.repeat(even[-1:], 2 * padding + 10, 0))
    )
    smooth = np.stack([np.convolve(column, window, 'valid') for column in padded.T], axis=1)
    positions = smooth[::10]
    positions[0], positions[-1] = corners[0], corners[-1]
    velocities = np.gradient(positions, _PERIOD_S, axis=0) if len(positions) > 1 else positions * 0
    velocities[0] = velocities[-1] = 0.0
    times_s = np.arange(len(positions), dtype=np.float64) * _PERIOD_S
    return ArmTrajectory(times_s, positions, velocities)
