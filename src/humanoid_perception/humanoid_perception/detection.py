# SPDX-License-Identifier: Apache-2.0
"""What a detector finds in a picture, and what every detector has in common."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from humanoid_common.errors import NodeStartError
import numpy as np
import numpy.typing as npt

__all__ = [
    'COLOURS',
    'CUT',
    'Box',
    'Box3',
    'Color',
    'Depth',
    'Detection',
    'Detector',
    'DetectorError',
    'is_cut',
]

Color = npt.NDArray[np.uint8]
"""(height, width, 3) red, green, blue"""
Depth = npt.NDArray[np.float32]
"""
(height, width) metres along the optical axis; NaN where nothing was measured, infinite beyond
reach.
"""
Box = tuple[float, float, float, float]
"""left, top, right, bottom in pixels; the picture goes from 0 to its width and height"""
CUT = 'cut'
"""The id of a detection that the border of the picture cuts."""
COLOURS = {
    'red': (0.85, 0.12, 0.1),
    'blue': (0.15, 0.3, 0.85),
    'green': (0.15, 0.6, 0.2),
    'yellow': (0.95, 0.85, 0.1),
    'orange': (0.95, 0.5, 0.1),
    'purple': (0.5, 0.2, 0.6),
    'pink': (0.95, 0.5, 0.65),
    'brown': (0.45, 0.28, 0.15),
    'white': (0.95, 0.95, 0.95),
    'grey': (0.5, 0.5, 0.5),
    'black': (0.08, 0.08, 0.08),
}
"""The names of colours, and how they look: red, green and blue from 0 to 1."""
_BORDER_PX = 1.5


class DetectorError(NodeStartError):
    """A detector cannot be used; the text says why, and what to do."""


@dataclass(frozen=True)
class Detection:
    """An object in a picture."""

    class_id: str
    score: float
    """0 to 1"""
    box_px: Box
    is_cut: bool = False
    """Whether the border of the picture cuts it: the object may go on beyond it."""
    colour: str = ''
    """The name of its colour, or '' if it has none that can be named."""
    colour_share: float = 0.0
    """How much of its surface has that colour, 0 to 1."""


@dataclass(frozen=True, eq=False)
class Box3:
    """The place and size of an object, in a frame whose z axis points up."""

    centre_m: npt.NDArray[np.float64]
    """(3,)"""
    size_m: npt.NDArray[np.float64]
    """(3,) along the axes of the box"""
    yaw_rad: float = 0.0
    """The turn of the box about the z axis."""


class Detector(Protocol):
    """Finds objects in pictures."""

    @property
    def title(self) -> str:
        """Name the detector for people: what it is, and from where."""

    def detect(
        self, color: Color, depth_m: Depth | None, focal_px: float, confidence: float, iou: float
    ) -> list[Detection]:
        """
        Detect objects in a picture.

        Parameters
        ----------
        color
            The picture (height, width, 3): red, green, blue.
        depth_m
            The depth (height, width) in m of the same pixels, along the optical axis; or None.
        focal_px
            The focal length in pixels; 0.0 if it is not known.
        confidence
            The least score of a detection, 0 to 1.
        iou
            The most by which two boxes of a class overlap, as intersection over union.

        Returns
        -------
        list of Detection
            Those of the best score first.

        """


def is_cut(box_px: Box, width_px: int, height_px: int) -> bool:
    """
    Whether a box touches the border of its picture, so that the object may go on beyond it.

    Parameters
    ----------
    box_px
        The box: left, top, right, bottom, in pixels.
    width_px, height_px
        The size of the picture.

    """
    left, top, right, bottom = box_px
    return (
        left <= _BORDER_PX
        or top <= _BORDER_PX
        or right >= width_px - _BORDER_PX
        or bottom >= height_px - _BORDER_PX
    )
