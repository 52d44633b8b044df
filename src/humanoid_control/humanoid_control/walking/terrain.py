# SPDX-License-Identifier: Apache-2.0
"""What is known of the ground: a piece of it under each foot, and what lies ahead."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math

from humanoid_control.dynamics.rotations import about_z
from humanoid_control.walking.planar import dot, limited, Point
from humanoid_control.walking.sides import other
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class GroundPlane:
    """A plane piece of ground, or a sole on it."""

    height_m: float = 0.0
    """Of the origin of the sole that stands on it."""
    tilt: Point = 0j
    """The horizontal part of its unit normal: where water would run."""

    def rotation(self, yaw_rad: float) -> Array:
        """
        Compute the rotation of a sole that stands flat on the plane.

        Parameters
        ----------
        yaw_rad
            The heading of the sole before it is tilted, in the odom frame.

        Returns
        -------
        Array
            Rotation matrix (3, 3) from the sole to the odom frame.

        """
        x, y = self.tilt.real, self.tilt.imag
        z = math.sqrt(max(0.0, 1.0 - x * x - y * y))
        k = 1.0 / (1.0 + z)
        # The shortest turn that takes the vertical to the normal (Rodrigues).
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
            How far away the point is, horizontally, in the axes of the odom frame.
        tilt
            Of the ground between the two, as `GroundPlane.tilt`.

        Returns
        -------
        float
            Height in m, from the same zero as that of the plane.

        """
        return self.height_m - dot(tilt, offset_m)


LEVEL = GroundPlane()


def tilt_of(rotation: Array, most_rad: float) -> Point:
    """
    Compute the tilt of a sole, limited to what ground may have.

    Parameters
    ----------
    rotation
        Rotation matrix (3, 3) from the sole to the odom frame.
    most_rad
        The steepest angle between the sole and the horizontal.

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
    How high the ground is above which the pendulum swings.

    It goes to the height of the feet, as they carry the weight, and gives way to where the
    centre of mass is measured: a landing that is too high or low gives no jolt. It stays near
    the feet, so that a robot which sinks does not take it along.
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
            The height of the feet that carry.
        below_com_m
            Where the ground would be if the centre of mass were as high as planned.
        passed_s
            The time since the last control period.

        """
        to_feet = 1.0 - math.exp(-self.rate_1_s * passed_s)
        to_com = 1.0 - math.exp(-self.leak_1_s * passed_s)
        before_m = self.height_m
        height_m = before_m + to_feet * (feet_m - before_m) + to_com * (below_com_m - before_m)
        away_m = limited(height_m - feet_m, -self.most_distance_m, self.most_distance_m)
        self.height_m = feet_m + away_m


class LevelFloor:
    """
    Height correction that takes footholds about as high as those before for one level floor.

    Odometry by the legs is a little off at each foothold, and an inertial sensor that takes level
    ground for a slope makes the robot climb as long as it walks ahead: without this, the height
    of the floor drifts by centimetres in a home. A foot that stands higher or lower than where it
    stood before, by more than a tolerance, is on a step or on a slope. Left and right are not
    compared: a sensor that leans aside sees one of them higher all the time.

    Parameters
    ----------
    tolerance_m
        How much higher or lower than before a foothold on the same floor may seem to be.

    """

    def __init__(self, tolerance_m: float) -> None:
        self._tolerance_m = tolerance_m
        self._before_m, self._rise_m = [0.0, 0.0], [0.0, 0.0]
        self._support: int | None = None

    def update(self, heights_m: Sequence[float], in_air: int | None) -> None:
        """
        Learn the drift of the height from a foot that has just taken the weight.

        Parameters
        ----------
        heights_m
            Of both feet, left and right, as odometry has them.
        in_air
            The side whose foot swings, so that the other one carries; None on both feet.

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
            Of the feet in the weight, left and right; they sum up to 1.

        Returns
        -------
        float
            In m, to be added to a height that odometry has.

        """
        return sum(share * rise_m for share, rise_m in zip(shares, self._rise_m))
