# SPDX-License-Identifier: Apache-2.0
"""How high the pelvis can be so that the legs reach the ground."""

from __future__ import annotations

from collections.abc import Sequence
import math

from humanoid_control.dynamics.frames import Frame
from humanoid_control.dynamics.leg_geometry import LegGeometry
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def reachable_height_m(
    base: Frame, legs: Sequence[LegGeometry], soles_m: Sequence[Array], reach: float
) -> float:
    """
    Return the height of the base, at most that which it has, at which legs reach their soles.

    :param soles_m: where the soles (3,) stand, level, one a leg
    :param reach: the share of its length to which a leg may be stretched
    """
    height_m = float(base.position_m[2])
    for leg, sole in zip(legs, soles_m):
        hip = base.rotation @ leg.hip_m
        x, y, _ = (base.position_m + hip - sole).tolist()
        stretched_m = reach * leg.length_m
        up_m = math.sqrt(max(0.0, stretched_m**2 - x**2 - y**2))
        ankle_m = float(sole[2] + leg.ankle_m[2])
        height_m = min(height_m, ankle_m + up_m - float(hip[2]))
    return height_m
