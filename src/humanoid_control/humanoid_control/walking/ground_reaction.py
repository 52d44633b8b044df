# SPDX-License-Identifier: Apache-2.0
"""Ground reaction force and its centre of pressure."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.walking.planar import limited, Point
from humanoid_control.walking.support_polygon import SupportPolygon
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class GroundReaction:
    """Ground reaction: a force (3,) at a point of the ground, and a torque about the vertical."""

    force_n: Array
    point_m: Point
    turn_nm: float

    @classmethod
    def of(cls, wrench: Array, base_m: Array) -> GroundReaction:
        """
        Compute the ground reaction that is equivalent to a wrench on the base.

        The force acts at the centre of pressure, where the ground exerts a torque only about the
        vertical.

        Parameters
        ----------
        wrench
            Force (N) and torque (N m) at the origin of base_link (6,), in the axes of odom.
        base_m
            Origin of base_link (3,): x and y in the odom frame, z above the ground.

        Returns
        -------
        GroundReaction
            Its point is in the odom frame.

        """
        x, y, z, about_x, about_y, about_z = wrench.tolist()
        down_m = -float(base_m[2])
        from_base = complex(down_m * x - about_y, down_m * y + about_x) / z
        turn_nm = about_z - (from_base.real * y - from_base.imag * x)
        return cls(wrench[:3], complex(base_m[0], base_m[1]) + from_base, turn_nm)

    def within(self, polygon: SupportPolygon, most_turn_nm: float) -> GroundReaction:
        """
        Clamp the reaction to what the feet on the ground can exert.

        The force is kept; its point moves into the support polygon. The torque that is missing
        rotates the robot, but does not move its centre of mass.

        Parameters
        ----------
        polygon
            Support polygon of the feet on the ground, in the odom frame.
        most_turn_nm
            Greatest torque about the vertical, in N m.

        """
        turn_nm = limited(self.turn_nm, -most_turn_nm, most_turn_nm)
        return GroundReaction(self.force_n, polygon.clamped(self.point_m), turn_nm)
