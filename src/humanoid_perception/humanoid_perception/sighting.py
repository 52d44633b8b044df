# SPDX-License-Identifier: Apache-2.0
"""What one detection says about where an object is, and how exactly."""

from __future__ import annotations

from dataclasses import dataclass
import math

import numpy as np
import numpy.typing as npt

__all__ = ['Sighting', 'greatest_sigma_m', 'sighting_noise']

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Sighting:
    """
    One 3-D detection, in the frame of the memory.

    Attributes
    ----------
    class_id, score
        Its class, and the confidence in it, from 0 to 1.
    position_m, size_m, yaw_rad
        Its upright bounding box: centre (3,), edge lengths (3,), and yaw.
    colour
        The name of its colour; empty if unknown.
    is_cut
        Whether the image border cuts it, which makes position and size unreliable.

    """

    class_id: str
    score: float
    position_m: Array
    size_m: Array
    yaw_rad: float = 0.0
    colour: str = ''
    is_cut: bool = False

    @property
    def is_sound(self) -> bool:
        """Whether all values are finite and within their ranges."""
        numbers = (self.score, *self.position_m, *self.size_m, self.yaw_rad)
        if not all(map(math.isfinite, numbers)) or not self.class_id:
            return False
        return 0.0 < self.score <= 1.0 and 0.0 < min(self.size_m) and max(self.size_m) < 5.0


def sighting_noise(
    position_m: Array, camera_m: Array, turn_rad_s: float = 0.0, base_m: float = 0.015
) -> Array:
    """
    Estimate the covariance (3, 3) in m^2 of the position of a detection.

    Along the ray, the depth error grows with the square of the range, as for stereo and structured
    light; across it, the bearing error grows with the range, and faster while the camera turns.

    Parameters
    ----------
    position_m, camera_m
        The positions of the detection and the camera (3,), in the frame of the covariance.
    turn_rad_s
        The turn rate of the camera.
    base_m
        The standard deviation along each axis due to the pose of the camera.

    """
    ray = position_m - camera_m
    range_m = max(float(np.linalg.norm(ray)), 1e-3)
    ahead = np.outer(ray, ray) / range_m**2
    along_m = 0.01 + 0.012 * range_m**2
    across_m = range_m * (0.010 + 0.03 * abs(turn_rad_s))
    noise = across_m**2 * (np.eye(3) - ahead) + along_m**2 * ahead
    return np.asarray(noise + base_m**2 * np.eye(3))


def greatest_sigma_m(covariance_m2: Array) -> float:
    """
    Compute the greatest standard deviation in m along an axis of the frame.

    Parameters
    ----------
    covariance_m2
        The covariance (n, n) of a position in m^2.

    """
    return math.sqrt(float(np.max(np.diag(covariance_m2))))
