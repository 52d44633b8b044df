# SPDX-License-Identifier: Apache-2.0
"""Detections in an image, and the common interface of detectors."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from humanoid_common.errors import UserError
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
(height, width) metres along the optical axis; NaN where nothing was measured, infinite beyond the
range of the camera.
"""
Box = tuple[float, float, float, float]
"""left, top, right, bottom in pixels; the image extends from 0 to its width and height"""
CUT = 'cut'
"""The id of a detection that the image border cuts."""
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
"""The names of colours, and their red, green and blue values from 0 to 1."""
_BORDER_PX = 1.5


class DetectorError(UserError):
    """A detector cannot be used; the message states why, and what to do."""


@dataclass(frozen=True)
class Detection:
    """An object detected in an image."""

    class_id: str
    score: float
    """0 to 1"""
    box_px: Box
    is_cut: bool = False
    """Whether the image border cuts it: the object may extend beyond it."""
    colour: str = ''
    """The name of its colour, or '' if none could be determined."""
    colour_share: float = 0.0
    """The fraction of its surface with that colour, 0 to 1."""


@dataclass(frozen=True, eq=False)
class Box3:
    """An upright 3-D bounding box, in a frame whose z axis points up."""

    centre_m: npt.NDArray[np.float64]
    """(3,)"""
    size_m: npt.NDArray[np.float64]
    """(3,) along the axes of the box"""
    yaw_rad: float = 0.0
    """The rotation of the box about the z axis."""


class Detector(Protocol):
    """Interface of object detectors."""

    @property
    def title(self) -> str:
        """Return the display name of the detector: its kind and its source."""

    def detect(
        self, color: Color, depth_m: Depth | None, focal_px: float, confidence: float, iou: float
    ) -> list[Detection]:
        """
        Detect objects in an image.

        Parameters
        ----------
        color
            The image (height, width, 3): red, green, blue.
        depth_m
            The depth (height, width) in m of the same pixels, along the optical axis; or None.
        focal_px
            The focal length in pixels; 0.0 if unknown.
        confidence
            The score threshold, 0 to 1.
        iou
            The largest intersection over union (IoU) of two boxes of a class.

        Returns
        -------
        list of Detection
            The detections, by decreasing score.

        """


def is_cut(box_px: Box, width_px: int, height_px: int) -> bool:
    """
    Check whether a box touches the image border, so that the object may extend beyond it.

    Parameters
    ----------
    box_px
        The box: left, top, right, bottom, in pixels.
    width_px, height_px
        The size of the image.

    """
    left, top, right, bottom = box_px
    return (
        left <= _BORDER_PX
        or top <= _BORDER_PX
        or right >= width_px - _BORDER_PX
        or bottom >= height_px - _BORDER_PX
    )
