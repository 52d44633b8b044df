# SPDX-License-Identifier: Apache-2.0
"""How all joints are to move."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class JointMotion:
    """Positions, velocities and accelerations of the joints, (n,) each."""

    positions_rad: Array
    velocities_rad_s: Array
    accelerations_rad_s2: Array
    """Those of the legs are left zero: they follow from the feet."""
