# SPDX-License-Identifier: Apache-2.0
"""Point clouds with channels."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rviz_default_plugins.decoding.geometry import FARTHEST, Points

__all__ = ['Cloud']


@dataclass(frozen=True)
class Cloud:
    """Points as rows x, y and z in metres; each channel has one value per point."""

    points: Points
    channels: dict[str, NDArray[Any]] = field(default_factory=dict)

    def __len__(self) -> int:
        """Return the number of points."""
        return len(self.points)

    def __getitem__(self, chosen: Any) -> Cloud:
        """Return a subset of the points."""
        channels = {name: values[chosen] for name, values in self.channels.items()}
        return Cloud(self.points[chosen], channels)

    def finite(self) -> Cloud:
        """Return the points with finite coordinates within `FARTHEST`."""
        somewhere = (np.abs(self.points) <= FARTHEST).all(axis=1)
        return self if somewhere.all() else self[somewhere]

    def thinned(self, most: int) -> Cloud:
        """
        Downsample the cloud: keep every n-th point.

        Parameters
        ----------
        most
            The maximum number of points to keep.

        """
        step = -(-len(self) // most)
        return self[::step] if step > 1 else self
