# SPDX-License-Identifier: Apache-2.0
"""Height of the base at which the legs reach the ground."""

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
    Compute the height of the base at which all legs reach their soles.

    The base is moved along the vertical only, and never up.

    Parameters
    ----------
    base
        Pose of the base, in the same frame as the soles.
    legs
        Geometry of the legs on the ground.
    soles_m
        Positions (3,) of their soles, which are level, one for each leg.
    reach
        Fraction of its length to which a leg may be stretched.

    Returns
    -------
    float
        Height of the base in m, in the frame of the soles.

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
