# SPDX-License-Identifier: Apache-2.0
"""Motion models: sample the motion of particles from odometry and its noise."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import Protocol, TypeVar

from nav2_amcl.occupancy_map import FloatArray
import numpy as np

__all__ = [
    'MOTION_MODELS',
    'DifferentialMotionModel',
    'MotionModel',
    'MotionNoise',
    'OmniMotionModel',
]

AngleT = TypeVar('AngleT', float, FloatArray)

Pose = tuple[float, float, float]
_NO_HEADING_M = 0.01
"""The direction of a shorter motion is undefined."""


@dataclass(frozen=True)
class MotionNoise:
    """
    The odometry noise alpha1 to alpha5: how much the variances grow with motion.

    `rotation_by_rotation`, `rotation_by_translation` (rad²/m²), `translation_by_translation`,
    `translation_by_rotation` (m²/rad²), `strafe_by_translation` for omnidirectional robots.
    """

    rotation_by_rotation: float = 0.2
    rotation_by_translation: float = 0.2
    translation_by_translation: float = 0.2
    translation_by_rotation: float = 0.2
    strafe_by_translation: float = 0.2


class MotionModel(Protocol):
    """Interface of motion models, which sample the poses of particles after a motion."""

    def move(
        self,
        particles: FloatArray,
        before: Pose,
        after: Pose,
        noise: MotionNoise,
        random: np.random.Generator,
    ) -> FloatArray:
        """
        Sample the particles after a motion.

        Parameters
        ----------
        particles
            (N, 3) array of x, y (m) and yaw (rad) in the frame of the map.
        before, after
            The robot in the frame of odometry: x, y (m), yaw (rad).
        noise
            The noise of odometry.
        random
            The random number generator.

        Returns
        -------
        A new (N, 3) array.

        """


def wrapped(angle_rad: AngleT) -> AngleT:
    """
    Wrap angles to the range from -pi, exclusive, to pi.

    Parameters
    ----------
    angle_rad
        An angle, or an array of them.

    """
    return math.pi - (math.pi - angle_rad) % (2.0 * math.pi)


class DifferentialMotionModel:
    """
    Motion model of differential drive robots: a rotation, a translation, a rotation.

    Source: Thrun, Burgard, Fox: Probabilistic Robotics, 2005, table 5.6. A robot that drives
    backward or sideways has not turned around first: the noise of the first rotation is limited to
    that of 90°.
    """

    def move(
        self,
        particles: FloatArray,
        before: Pose,
        after: Pose,
        noise: MotionNoise,
        random: np.random.Generator,
    ) -> FloatArray:
        """
        Sample the particles after a motion.

        Parameters
        ----------
        particles, before, after, noise, random
            As for `MotionModel.move`.

        Returns
        -------
        numpy.ndarray
            New particles (N, 3); their yaw is not wrapped.

        """
        dx, dy = after[0] - before[0], after[1] - before[1]
        length = math.hypot(dx, dy)
        first = 0.0 if length < _NO_HEADING_M else wrapped(math.atan2(dy, dx) - before[2])
        last = wrapped(after[2] - before[2] - first)

        def variance(turn: float) -> float:
            turned = min(abs(turn), abs(wrapped(turn - math.pi)))
            return (
                noise.rotation_by_rotation * turned**2 + noise.rotation_by_translation * length**2
            )

        turned = sum(min(abs(t), abs(wrapped(t - math.pi))) ** 2 for t in (first, last))
        spread = math.sqrt(
            noise.translation_by_translation * length**2 + noise.translation_by_rotation * turned
        )
        count = len(particles)
        headings = particles[:, 2] + first + random.normal(0.0, math.sqrt(variance(first)), count)
        lengths = length + random.normal(0.0, spread, count)
        moved = np.empty_like(particles)
        moved[:, 0] = particles[:, 0] + lengths * np.cos(headings)
        moved[:, 1] = particles[:, 1] + lengths * np.sin(headings)
        moved[:, 2] = headings + last + random.normal(0.0, math.sqrt(variance(last)), count)
        return moved


class OmniMotionModel:
    """
    Motion model of omnidirectional robots: a translation in any direction, and a rotation.

    Both are noisy; across the direction of motion, noise grows with `strafe_by_translation`.
    """

    def move(
        self,
        particles: FloatArray,
        before: Pose,
        after: Pose,
        noise: MotionNoise,
        random: np.random.Generator,
    ) -> FloatArray:
        """
        Sample the particles after a motion.

        Parameters
        ----------
        particles, before, after, noise, random
            As for `MotionModel.move`.

        Returns
        -------
        numpy.ndarray
            New particles (N, 3); their yaw is not wrapped.

        """
        dx, dy = after[0] - before[0], after[1] - before[1]
        length, turn = math.hypot(dx, dy), wrapped(after[2] - before[2])
        bearing = math.atan2(dy, dx) - before[2]
        along = noise.translation_by_translation * length**2
        across = noise.strafe_by_translation * length**2
        by_turn = noise.translation_by_rotation * turn**2
        turned = noise.rotation_by_rotation * turn**2 + noise.rotation_by_translation * length**2
        count = len(particles)
        forward = length + random.normal(0.0, math.sqrt(along + by_turn), count)
        sideways = random.normal(0.0, math.sqrt(across + by_turn), count)
        headings = particles[:, 2] + bearing
        cos, sin = np.cos(headings), np.sin(headings)
        moved = np.empty_like(particles)
        moved[:, 0] = particles[:, 0] + forward * cos - sideways * sin
        moved[:, 1] = particles[:, 1] + forward * sin + sideways * cos
        moved[:, 2] = particles[:, 2] + turn + random.normal(0.0, math.sqrt(turned), count)
        return moved


MOTION_MODELS: dict[str, MotionModel] = {
    'nav2_amcl::DifferentialMotionModel': DifferentialMotionModel(),
    'nav2_amcl::OmniMotionModel': OmniMotionModel(),
}
"""The motion models by `robot_model_type`."""
