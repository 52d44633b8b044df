# SPDX-License-Identifier: Apache-2.0
"""Common interface of the renderers, and their image types."""

from __future__ import annotations

from typing import Protocol

import mujoco
import numpy as np
from numpy.typing import NDArray

NEAR_M = 0.02
FAR_M = 100.0
HIDDEN_GROUP = 3
"""Geoms of this group and those above it only collide; they are not rendered."""
SEEN_GROUPS = np.array([group < HIDDEN_GROUP for group in range(6)], dtype=np.uint8)
"""For each geom group, whether rays hit it, in the format of `mj_multiRay`."""

Color = NDArray[np.uint8]
"""(height, width, 3) red, green, blue"""

Depth = NDArray[np.float32]
"""(height, width) metres along the optical axis; infinite where nothing is seen (REP 118)"""

Cloud = NDArray[np.float32]
"""(height, width, 3) points in metres in the optical frame; NaN where nothing is seen"""


class Painter(Protocol):
    """Renderer of the cameras of a model."""

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
            Images of the same size to be filled, see `Color` and `Depth`; None is skipped.

        """

    def close(self) -> None:
        """Release all resources."""
