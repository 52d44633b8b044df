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
class Facet:
    """A plane piece of ground, or a sole on it."""

    height_m: float = 0.0
    """Of the origin of the sole that stands on it."""
    tilt: Point = 0j
    """The horizontal part of its unit normal: where water would run."""

    def rotation(self, yaw_rad: float) -> Array:
        """Return how a sole is turned, (3, 3), that stands flat on it and faces a direction."""
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
        """Return how high ground of a tilt is that goes on from here, somewhere beside."""
        return self.height_m - dot(tilt, offset_m)


LEVEL = Facet()


def tilt_of(rotation: Array, most_rad: float) -> Point:
    """Return the tilt of a sole, cut to what ground may have."""
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
        Let time pass.

        :param feet_m: the height of the feet that carry
        :param below_com_m: where the ground would be if the centre of mass were as high as planned
        """
        to_feet = 1.0 - math.exp(-self.rate_1_s * passed_s)
        to_com = 1.0 - math.exp(-self.leak_1_s * passed_s)
        before_m = self.height_m
        height_m = before_m + to_feet * (feet_m - before_m) + to_com * (below_com_m - before_m)
        away_m = limited(height_m - feet_m, -self.most_distance_m, self.most_distance_m)
        self.height_m = feet_m + away_m


class LevelFloor:
    """
    Takes footholds that are about as high as those before for one floor, as rooms have.

    Odometry by the legs is a little off at each foothold, and an inertial sensor that takes level
    ground for a slope makes the robot climb as long as it walks ahead: without this, the height
    of the floor drifts by centimetres in a home. A foot that stands higher or lower than where it
    stood before, by more than a tolerance, is on a step or on a slope. Left and right are not
    compared: a sensor that leans aside sees one of them higher all the time.
    """

    def __init__(self, tolerance_m: float) -> None:
        """
        Begin with both feet on the ground.

        :param tolerance_m: by how much a level foothold may seem to be higher or lower
        """
        self._tolerance_m = tolerance_m
        self._before_m, self._rise_m = [0.0, 0.0], [0.0, 0.0]
        self._support: int | None = None

    def update(self, heights_m: Sequence[float], in_air: int | None) -> None:
        """
        Take note of where the feet are.

        :param heights_m: of both feet, left and right, as odometry has them
        :param in_air: the side whose foot swings: that of the other one is known then
        """
        if in_air is None or self._support == other(in_air):
            return
        side = self._support = other(in_air)
        step_m = heights_m[side] - self._before_m[side]
        if abs(step_m) <= self._tolerance_m:
            self._rise_m[side] -= step_m
        self._before_m[side] = heights_m[side]

    def rise_m(self, shares: Sequence[float]) -> float:
        """Return by how much all is higher than odometry has it, by the feet that carry."""
        return sum(share * rise_m for share, rise_m in zip(shares, self._rise_m))
