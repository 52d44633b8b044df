# SPDX-License-Identifier: Apache-2.0
"""How what a robot measures is put into one array, but for the orientation."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Channels:
    """The parts of an array of so many values; feet are left, right."""

    positions: slice
    velocities: slice
    efforts: slice
    angular_velocity: slice
    acceleration: slice
    forces: slice
    torques: slice

    @property
    def size(self) -> int:
        """Return how many values there are."""
        return int(self.torques.stop)


def channels_of(joints: int) -> Channels:
    """
    Divide the measurements of a robot among the slices of one array.

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
