# SPDX-License-Identifier: Apache-2.0
"""What is known of the ground: a piece of it under each foot, and what lies ahead."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.dynamics.rotations import about_z
from humanoid_control.walking.planar import dot, limited, Point
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
