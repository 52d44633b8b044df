# SPDX-License-Identifier: Apache-2.0
"""
Detect objects of a uniform colour without a neural network: by colour, shape and depth.

Connected pixels with the same colour name, at about the same depth, form one object. Its class
follows from its contour alone: one that fills its enclosing circle is a ball; one that fills its
bounding rectangle is a cube, a can, a bottle or a box, by its aspect ratio. The detector is meant
for scenes of plain toys on plain ground: a red cupboard door is too large to count, but a red
cushion is a box.
"""

from __future__ import annotations

from collections.abc import Iterator
import math

import cv2
from humanoid_perception.colours import CHROMATIC, name_pixels
from humanoid_perception.detection import Color, Depth, Detection, is_cut
import numpy as np
import numpy.typing as npt

__all__ = ['ColourDetector']

_LEAST_PIXELS = 40
_LARGEST_SHARE = 0.2
"""Largest region as a fraction of the image; larger ones are walls or the floor."""
_SMALLEST_M, _LARGEST_M = 0.02, 0.6
_STEP_M, _STEP_SHARE = 0.03, 0.02
"""Neighbouring pixels are separate if their depths differ by more than both, the second being a
fraction of the depth."""
_BALL_FILL, _BOX_FILL = 0.86, 0.8
_CLASSES = ((0.75, 'box'), (1.3, 'cube'), (2.2, 'can'), (math.inf, 'bottle'))
"""Classes of contours that fill their rectangle, each up to an aspect ratio (height by width)."""


class ColourDetector:
    """Detector of objects of a uniform colour."""

    @property
    def title(self) -> str:
        """Return the display name of the detector."""
        return 'colour, shape and depth (no model)'

    def detect(
        self,
        color: Color,
        depth_m: Depth | None = None,
        focal_px: float = 0.0,
        confidence: float = 0.4,
        iou: float = 0.5,
    ) -> list[Detection]:
        """
        Detect objects as connected regions of one colour, which never share a pixel.

        Parameters
        ----------
        color, depth_m, focal_px
            As for `Detector.detect`. Depth separates regions that only appear connected; with the
            focal length, it rules out regions that are too small or too large for an object.
        confidence
            The score threshold; the score is how well a contour fits its class.
        iou
            Ignored.

        Returns
        -------
        list of Detection
            The detections, by decreasing score.

        """
        del iou
        size_px = color.shape[1], color.shape[0]
        names = name_pixels(np.asarray(cv2.medianBlur(color, 3), dtype=np.uint8))
        if depth_m is not None:
            names[_depth_steps(depth_m)] = len(CHROMATIC)
        found = [
            detection
            for number, name in enumerate(CHROMATIC)
            for region in _regions(names == number)
            if (detection := _detection(region, name, size_px, depth_m, focal_px)) is not None
        ]
        return sorted(
            (each for each in found if each.score >= confidence), key=lambda each: -each.score
        )


class _Region:
    """A connected region of pixels."""

    def __init__(self, mask: npt.NDArray[np.bool_], left: int, top: int) -> None:
        self.mask, self.left, self.top = mask, left, top
        self.pixels = int(np.count_nonzero(mask))
        self.outline = _outline_of(mask)


def _depth_steps(depth_m: Depth) -> npt.NDArray[np.bool_]:
    """Find the pixels that are farther than one of their four neighbours by a depth step."""
    steps = np.zeros(depth_m.shape, dtype=np.bool_)
    with np.errstate(invalid='ignore'):
        for depths, marked in ((depth_m, steps), (depth_m.T, steps.T)):
            change, least = np.diff(depths, axis=0), np.maximum(_STEP_M, _STEP_SHARE * depths)
            marked[:-1] |= -change > least[:-1]
            marked[1:] |= change > least[1:]
    return steps


def _regions(mask: npt.NDArray[np.bool_]) -> Iterator[_Region]:
    """Yield the connected regions of a mask that are neither specks nor walls."""
    if np.count_nonzero(mask) < _LEAST_PIXELS:
        return
    count, labels, stats, _ = cv2.connectedComponentsWithStats(mask.view(np.uint8), connectivity=4)
    for number in range(1, count):
        left, top, width, height, pixels = (int(value) for value in stats[number])
        if _LEAST_PIXELS <= pixels <= _LARGEST_SHARE * mask.size:
            rows, columns = slice(top, top + height), slice(left, left + width)
            part = labels[rows, columns] == number
            yield _Region(part, left, top)


def _outline_of(mask: npt.NDArray[np.bool_]) -> npt.NDArray[np.int32]:
    """Return the outer contour (n, 1, 2) of a region."""
    padded = np.pad(mask.view(np.uint8), 1)
    contours, _ = cv2.findContours(padded, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    return np.asarray(max(contours, key=len), dtype=np.int32)


def _detection(
    region: _Region,
    colour: str,
    picture_px: tuple[int, int],
    depth_m: Depth | None,
    focal_px: float,
) -> Detection | None:
    """Classify a region as a detection; None if it does not have the size of an object."""
    height, width = region.mask.shape
    if not _is_object_sized(region, depth_m, focal_px):
        return None
    class_id, score = _shape_of(region)
    box_px = (
        float(region.left),
        float(region.top),
        float(region.left + width),
        float(region.top + height),
    )
    return Detection(class_id, score, box_px, is_cut(box_px, *picture_px), colour, 1.0)


def _is_object_sized(region: _Region, depth_m: Depth | None, focal_px: float) -> bool:
    """Whether a region has the size of a graspable object; True without depth."""
    if depth_m is None or focal_px <= 0.0:
        return True
    height, width = region.mask.shape
    rows = slice(region.top, region.top + height)
    columns = slice(region.left, region.left + width)
    distances = depth_m[rows, columns][region.mask]
    distances = distances[np.isfinite(distances)]
    if not len(distances):
        return True
    metres_px = float(np.median(distances)) / focal_px
    return bool(_SMALLEST_M <= metres_px * max(height, width) <= _LARGEST_M)


def _shape_of(region: _Region) -> tuple[str, float]:
    """Classify the shape of a region; return the class, and how well it fits, 0 to 1."""
    area = float(cv2.contourArea(cv2.convexHull(region.outline))) + 0.5 * len(region.outline)
    height, width = region.mask.shape
    _, radius = cv2.minEnclosingCircle(region.outline)
    circle_fill = area / (math.pi * (radius + 0.5) ** 2)
    solidity = region.pixels / max(area, 1.0)
    if circle_fill >= _BALL_FILL:
        return 'ball', min(1.0, circle_fill * solidity)
    box_fill = area / (height * width)
    class_id = next(name for most, name in _CLASSES if height / width <= most)
    return class_id, min(1.0, box_fill * solidity) if box_fill >= _BOX_FILL else 0.0
