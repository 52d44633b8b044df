# SPDX-License-Identifier: Apache-2.0
"""Poses and twists of moving frames, relative to each other."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_description.rotations import skew
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Frame:
    """Pose of a frame in another: the position (3,) of its origin and its rotation (3, 3)."""

    position_m: Array
    rotation: Array

    def seen_from(self, base: Frame) -> Frame:
        """
        Express this frame relative to another.

        Parameters
        ----------
        base
            The other frame, in the same parent as this one.

        Returns
        -------
        Frame
            Position in m and rotation in the axes of `base`.

        """
        inverse = base.rotation.T
        return Frame(inverse @ (self.position_m - base.position_m), inverse @ self.rotation)


@dataclass(frozen=True, eq=False)
class Twist:
    """Twist of a frame in another: linear velocity (3,) of its origin, angular velocity (3,)."""

    linear_m_s: Array
    angular_rad_s: Array

    def seen_from(self, base: Frame, base_twist: Twist, position_m: Array) -> Twist:
        """
        Express the twist of a frame relative to another moving frame.

        All arguments and this twist are given in the axes of a common parent.

        Parameters
        ----------
        base, base_twist
            The other frame, and its twist.
        position_m
            The origin of the frame that has this twist (3,).

        Returns
        -------
        Twist
            The motion as seen by an observer that moves with `base`, in the axes of `base`.

        """
        lever = position_m - base.position_m
        carried = base_twist.linear_m_s + skew(base_twist.angular_rad_s) @ lever
        inverse = base.rotation.T
        return Twist(
            inverse @ (self.linear_m_s - carried),
            inverse @ (self.angular_rad_s - base_twist.angular_rad_s),
        )
