# SPDX-License-Identifier: Apache-2.0
"""Ground model: planes below the feet, the ground level, and the drift of the height."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math

from humanoid_control.walking.planar import dot, limited, Point
from humanoid_control.walking.sides import other
from humanoid_description.rotations import about_z
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class GroundPlane:
    """Ground plane below a foot, or the plane of a sole."""

    height_m: float = 0.0
    """Height of the origin of a sole that stands on it."""
    tilt: Point = 0j
    """Horizontal part of its unit normal, which points downhill."""

    def rotation(self, yaw_rad: float) -> Array:
        """
        Compute the rotation of a sole that stands flat on the plane.

        Parameters
        ----------
        yaw_rad
            Heading of the sole before it is tilted, in the odom frame.

        Returns
        -------
        Array
            Rotation matrix (3, 3) from the sole to the odom frame.

        """
        x, y = self.tilt.real, self.tilt.imag
        z = math.sqrt(max(0.0, 1.0 - x * x - y * y))
        k = 1.0 / (1.0 + z)
        # The shortest rotation from the vertical to the normal (Rodrigues).
        leaning = np.array(
            [[1.0 - k * x * x, -k * x * y, x], [-k * x * y, 1.0 - k * y * y, y], [-x, -y, z]]
        )
        rotation: Array = leaning @ about_z(yaw_rad)
        return rotation

    def height_beside(self, offset_m: Point, tilt: Point) -> float:
        """
        Extrapolate the height of the ground to a point beside the plane's origin.

        Parameters
        ----------
        offset_m
            Horizontal offset of the point, in the axes of the odom frame.
        tilt
            Tilt of the ground between the two, as `GroundPlane.tilt`.

        Returns
        -------
        float
            Height in m, with the same zero as that of the plane.

        """
        return self.height_m - dot(tilt, offset_m)


LEVEL = GroundPlane()


def tilt_of(rotation: Array, most_rad: float) -> Point:
    """
    Compute the tilt of a sole, clamped to the maximum slope of the ground.

    Parameters
    ----------
    rotation
        Rotation matrix (3, 3) from the sole to the odom frame.
    most_rad
        Greatest angle between the sole and the horizontal.

    Returns
    -------
    Point
        As `GroundPlane.tilt`, in the axes of the odom frame.

    """
    tilt = complex(rotation[0, 2], rotation[1, 2])
    size = abs(tilt)
    return tilt * min(1.0, math.sin(most_rad) / size) if size > 0.0 else tilt


@dataclass
class GroundLevel:
    """
    Low-pass filter of the ground level below the pendulum.

    It follows the height of the feet, weighted by their load, and leaks to the level that the
    measured centre of mass implies, so that a landing that is too high or too low causes no jolt.
    It stays near the feet, so that a robot that sinks does not drag it down.
    """

    rate_1_s: float
    leak_1_s: float
    most_distance_m: float
    height_m: float = 0.0

    def update(self, feet_m: float, below_com_m: float, passed_s: float) -> None:
        """
        Low-pass filter the height of the ground below the pendulum.

        Parameters
        ----------
        feet_m
            Mean height of the feet, weighted by their load.
        below_com_m
            Ground level at which the measured centre of mass would be at its planned height.
        passed_s
            Time since the last control period.

        """
        to_feet = 1.0 - math.exp(-self.rate_1_s * passed_s)
        to_com = 1.0 - math.exp(-self.leak_1_s * passed_s)
        before_m = self.height_m
        height_m = before_m + to_feet * (feet_m - before_m) + to_com * (below_com_m - before_m)
        away_m = limited(height_m - feet_m, -self.most_distance_m, self.most_distance_m)
        self.height_m = feet_m + away_m


class LevelFloor:
    """
    Height correction that treats successive footholds of about the same height as a level floor.

    Leg odometry has a small error at each foothold, and an IMU with a pitch bias makes the robot
    seem to climb as long as it walks forward: without this correction, the height of the floor
    drifts by centimetres in a home. A foot that stands higher or lower than its previous
    foothold, by more than a tolerance, is on a step or on a slope. Left and right are not
    compared: with a roll bias of the IMU, one of them always seems higher.

    Parameters
    ----------
    tolerance_m
        Greatest apparent difference in height between successive footholds on the same floor.

    """

    def __init__(self, tolerance_m: float) -> None:
        self._tolerance_m = tolerance_m
        self._before_m, self._rise_m = [0.0, 0.0], [0.0, 0.0]
        self._support: int | None = None

    def update(self, heights_m: Sequence[float], in_air: int | None) -> None:
        """
        Estimate the drift of the height from a foot that has just taken the weight.

        Parameters
        ----------
        heights_m
            Heights of both feet by odometry, left and right.
        in_air
            Side of the swing foot; the other one carries. None if both feet are on the ground.

        """
        if in_air is None or self._support == other(in_air):
            return
        side = self._support = other(in_air)
        step_m = heights_m[side] - self._before_m[side]
        if abs(step_m) <= self._tolerance_m:
            self._rise_m[side] -= step_m
        self._before_m[side] = heights_m[side]

    def rise_m(self, shares: Sequence[float]) -> float:
        """
        Compute the correction that cancels the drift of the height.

        Parameters
        ----------
        shares
            Load distribution, left and right; the sum is 1.

        Returns
        -------
        float
            Correction in m, to be added to a height by odometry.

        """
        return sum(share * rise_m for share, rise_m in zip(shares, self._rise_m))
