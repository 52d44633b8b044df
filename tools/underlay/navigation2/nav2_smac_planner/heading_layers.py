# SPDX-License-Identifier: Apache-2.0
"""Where a robot with a footprint collides, for each of its headings."""

from __future__ import annotations

import math

import cv2
from nav2_costmap_2d.costs import INSCRIBED_INFLATED_OBSTACLE, LETHAL_OBSTACLE, NO_INFORMATION
from nav2_costmap_2d.footprint import transformed
from nav2_costmap_2d.grid import Costmap2D
import numpy as np
import numpy.typing as npt

__all__ = ['HeadingLayers']

MaskGrid = npt.NDArray[np.bool_]
_FRACTION_BITS = 4


class HeadingLayers:
    """
    Masks of the cells at which the robot collides, one for each heading; made when needed.

    Parameters
    ----------
    costmap
        The costs.
    footprint
        (N, 2) corners in m in the base frame; None for a circular robot.
    headings
        The number of headings, evenly spaced from yaw 0.
    allow_unknown
        Whether the robot may be in unknown space.

    """

    def __init__(
        self,
        costmap: Costmap2D,
        footprint: npt.NDArray[np.float64] | None,
        headings: int,
        allow_unknown: bool,
    ) -> None:
        self._footprint, self._headings = footprint, headings
        self._resolution = costmap.resolution
        cells = costmap.cells
        unknown = cells == NO_INFORMATION
        self._centre: MaskGrid = (cells >= INSCRIBED_INFLATED_OBSTACLE) & ~unknown
        self._lethal = (cells == LETHAL_OBSTACLE).astype(np.uint8)
        if not allow_unknown:
            self._centre |= unknown
            self._lethal[unknown] = 1
        self._layers: dict[int, bytes] = {}

    @property
    def centre(self) -> MaskGrid:
        """(rows, columns) cells at which the robot collides with any heading."""
        return self._centre

    def layer(self, heading: int) -> bytes:
        """
        Return the mask of a heading, flat: a byte for each cell, 0 where the robot is free.

        Parameters
        ----------
        heading
            The number of the heading, from 0.

        """
        key = 0 if self._footprint is None else heading
        found = self._layers.get(key)
        if found is None:
            found = self._layers[key] = self._make(heading).tobytes()
        return found

    def _make(self, heading: int) -> MaskGrid:
        if self._footprint is None:
            return self._centre
        yaw = heading * 2.0 * math.pi / self._headings
        corners = transformed(self._footprint, 0.0, 0.0, yaw) / self._resolution
        reach = math.ceil(float(np.abs(corners).max())) + 1
        kernel = np.zeros((2 * reach + 1, 2 * reach + 1), np.uint8)
        fixed = np.rint((corners + reach) * (1 << _FRACTION_BITS)).astype(np.int32)
        cv2.fillPoly(kernel, [fixed], 1, shift=_FRACTION_BITS)
        hit = cv2.dilate(self._lethal, kernel, borderType=cv2.BORDER_CONSTANT, borderValue=1)
        mask: MaskGrid = self._centre | (hit > 0)
        return mask
