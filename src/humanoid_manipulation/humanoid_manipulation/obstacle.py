# SPDX-License-Identifier: Apache-2.0
"""What the arms must not touch: a box, around the robot or in a hand."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.dynamics.frames import Frame
from humanoid_manipulation.errors import ManipulationError
import numpy as np

__all__ = ['Obstacle']


@dataclass(frozen=True, eq=False)
class Obstacle:
    """
    A box-shaped obstacle.

    Attributes
    ----------
    name
        The name in messages.
    middle
        The pose of its centre: in the pelvis frame, or, for a held object, in the gripper frame.
    size_m
        Its edge lengths (3,) along its axes.

    """

    name: str
    middle: Frame
    size_m: tuple[float, float, float]

    def __post_init__(self) -> None:
        """Validate the pose and the size."""
        numbers = (*self.size_m, *self.middle.position_m, *self.middle.rotation.ravel())
        if min(self.size_m) <= 0.0 or not np.isfinite(numbers).all():
            raise ManipulationError(f"'{self.name}' is not a box: its edges are {self.size_m} m.")
