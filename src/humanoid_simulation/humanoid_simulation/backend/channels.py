# SPDX-License-Identifier: Apache-2.0
"""Layout of a robot's measurements in one flat array; the orientation is kept apart."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Channels:
    """Slices of the measurement array, by quantity; feet in the order left, right."""

    positions: slice
    velocities: slice
    efforts: slice
    angular_velocity: slice
    acceleration: slice
    forces: slice
    torques: slice

    @property
    def size(self) -> int:
        """Return the number of values in the array."""
        return int(self.torques.stop)


def channels_of(joints: int) -> Channels:
    """
    Assign the measurements of a robot to slices of one array.

    Parameters
    ----------
    joints
        Number n of driven joints.

    Returns
    -------
    Channels
        Slices of an array (3 n + 18,).

    """
    parts = []
    at = 0
    for length in (joints, joints, joints, 3, 3, 6, 6):
        parts.append(slice(at, at + length))
        at += length
    return Channels(*parts)
