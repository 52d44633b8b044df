# SPDX-License-Identifier: Apache-2.0
"""What every way to draw has in common."""

from __future__ import annotations

from typing import Protocol

import mujoco
import numpy as np
from numpy.typing import NDArray

NEAR_M = 0.02
FAR_M = 100.0
HIDDEN_GROUP = 3
"""The group of geoms, and those above it, that only collisions see."""
SEEN_GROUPS = np.array([group < HIDDEN_GROUP for group in range(6)], dtype=np.uint8)
"""For each group of geoms, whether rays meet it, as `mj_multiRay` wants that."""

Color = NDArray[np.uint8]
"""(height, width, 3) red, green, blue"""

Depth = NDArray[np.float32]
"""(height, width) metres along the optical axis; infinite where nothing is (REP 118)"""

Cloud = NDArray[np.float32]
"""(height, width, 3) points in metres in the optical frame; NaN where nothing is seen"""


class Painter(Protocol):
    """Draws what the cameras of a model see."""

    def draw(
        self, data: mujoco.MjData, camera: int, color: Color | None, depth: Depth | None
    ) -> None:
        """
        Render the images of a camera into the given arrays.

        Parameters
        ----------
        data
            The state, with bodies, cameras and lights placed (`mj_kinematics`, `mj_camlight`).
        camera
            The id of the camera in the model.
        color, depth
            Images of one size to be filled, see `Color` and `Depth`; None is left out.

        """

    def close(self) -> None:
        """Give back what is held."""
