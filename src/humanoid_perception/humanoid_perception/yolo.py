# SPDX-License-Identifier: Apache-2.0
"""
Pre- and postprocessing for YOLO networks: letterboxing, output decoding, and NMS.

The output layouts of exported models of the YOLO families:

==================  ===================  ==========================================================
`scores`            [1, 4 + classes, N]  v8, v9, v11, v12: centre x, y, width, height; scores
`objectness`        [1, N, 5 + classes]  v5, v7: the same, with an additional objectness score
`end_to_end`        [1, N, 6]            v10, v26: left, top, right, bottom, score, class; without
                                         duplicates
==================  ===================  ==========================================================
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import cv2
from humanoid_perception.detection import Box, Color, DetectorError
import numpy as np
import numpy.typing as npt

__all__ = [
    'AUTO',
    'END_TO_END',
    'LAYOUTS',
    'OBJECTNESS',
    'SCORES',
    'Candidates',
    'Letterbox',
    'candidates_in',
    'layout_of',
    'letterbox_size',
    'suppressed',
]

AUTO, SCORES, OBJECTNESS, END_TO_END = 'auto', 'scores', 'objectness', 'end_to_end'
LAYOUTS = (AUTO, SCORES, OBJECTNESS, END_TO_END)
_PAD = 114
_MOST = 300
"""Largest number of boxes per image."""
_MOST_CANDIDATES = 2000
_END_TO_END_ROWS = 1000
"""Largest number of boxes of end-to-end networks; others output thousands."""

Array = npt.NDArray[np.float32]


@dataclass(frozen=True)
class Letterbox:
    """The mapping of an image into the input of a network: scaled, with padding around it."""

    width_px: int
    height_px: int
    """The size of the image."""
    scaled_width_px: int
    scaled_height_px: int
    left_px: int
    top_px: int
    """The top left corner of the scaled image in the input."""

    @classmethod
    def of(cls, picture: tuple[int, int], size: tuple[int, int]) -> Letterbox:
        """
        Fit an image into the centre of the input of a network, keeping its aspect ratio.

        Parameters
        ----------
        picture, size
            The sizes (height, width) in pixels of the image and of the input.

        """
        height_px, width_px = picture
        scale = min(size[0] / height_px, size[1] / width_px)
        scaled_width = max(1, round(width_px * scale))
        scaled_height = max(1, round(height_px * scale))
        left = round((size[1] - scaled_width) / 2 - 0.1)
        top = round((size[0] - scaled_height) / 2 - 0.1)
        return cls(width_px, height_px, scaled_width, scaled_height, max(left, 0), max(top, 0))

    def apply(self, color: Color, size: tuple[int, int]) -> Color:
        """
        Scale an image to the input of a network, and pad it with grey.

        Parameters
        ----------
        color
            The image (height, width, 3), of the size that the letterbox is for.
        size
            The size (height, width) in pixels of the input.

        Returns
        -------
        Color
            The input (height, width, 3); `color` itself if it has that size.

        """
        scaled = (self.scaled_width_px, self.scaled_height_px)
        if (self.width_px, self.height_px) != scaled:
            resized = cv2.resize(color, scaled, interpolation=cv2.INTER_LINEAR)
            color = np.asarray(resized, dtype=np.uint8)
        if scaled == (size[1], size[0]):
            return color
        padded = np.full((*size, 3), _PAD, dtype=np.uint8)
        rows = slice(self.top_px, self.top_px + self.scaled_height_px)
        columns = slice(self.left_px, self.left_px + self.scaled_width_px)
        padded[rows, columns] = color
        return padded

    def undo(self, boxes_px: Array) -> Array:
        """
        Transform boxes from the input of the network to the image, and clip them to its border.

        Parameters
        ----------
        boxes_px
            Left, top, right and bottom of each box (n, 4), in pixels of the input.

        Returns
        -------
        Array
            The boxes in pixels of the image (n, 4).

        """
        scale_x = self.width_px / self.scaled_width_px
        scale_y = self.height_px / self.scaled_height_px
        shift = np.array([self.left_px, self.top_px] * 2, dtype=np.float32)
        scale = np.array([scale_x, scale_y] * 2, dtype=np.float32)
        most = np.array([self.width_px, self.height_px] * 2, dtype=np.float32)
        return np.asarray(np.clip((boxes_px - shift) * scale, 0.0, most))


def letterbox_size(picture: tuple[int, int], longest_px: int, stride_px: int) -> tuple[int, int]:
    """
    Compute the smallest input size that fits an image, for networks with dynamic input size.

    Parameters
    ----------
    picture
        The size (height, width) in pixels of the image.
    longest_px
        The length to which the longer edge is scaled.
    stride_px
        The edges of the input are rounded up to multiples of this.

    Returns
    -------
    tuple of int
        The size (height, width) in pixels of the input.

    """
    scale = longest_px / max(picture)
    height, width = (
        max(stride_px, -(-round(edge * scale) // stride_px) * stride_px) for edge in picture
    )
    return height, width


@dataclass(frozen=True, eq=False)
class Candidates:
    """Candidate boxes from the output of a network."""

    boxes_px: Array
    """(n, 4) left, top, right, bottom, in pixels of the input"""
    scores: Array
    """(n,)"""
    classes: npt.NDArray[np.int64]
    """(n,)"""


def layout_of(
    shape: Sequence[int], class_count: int | None, metadata: dict[str, str], told: str = AUTO
) -> tuple[str, int]:
    """
    Determine the layout of an output, and its number of classes (0 if the shape does not tell).

    Parameters
    ----------
    shape
        The shape of an output of the network.
    class_count
        The number of known class names; None if there are none.
    metadata
        The metadata of the model file.
    told
        The layout given by the user, or `AUTO`.

    Raises
    ------
    DetectorError
        The output is not that of a detector, or does not have the given layout.

    """
    if len(shape) != 3 or shape[0] != 1 or min(shape) < 1:
        raise DetectorError(_not_a_detector(shape))
    rows, columns = int(shape[1]), int(shape[2])
    layout = told if told != AUTO else _guess(rows, columns, class_count, metadata)
    counts = {SCORES: rows - 4, OBJECTNESS: columns - 5, END_TO_END: 0 if columns == 6 else -1}
    count = counts.get(layout, -1)
    if count < (0 if layout == END_TO_END else 1):
        raise DetectorError(_not_a_detector(shape) if told == AUTO else _unfit(shape, told))
    return layout, count


def _guess(rows: int, columns: int, class_count: int | None, metadata: dict[str, str]) -> str:
    """Guess the layout of an output [1, rows, columns]; empty if it is ambiguous."""
    if columns == 6:
        if metadata.get('end2end', '').strip().lower() == 'true':
            return END_TO_END
        if rows <= _END_TO_END_ROWS and rows - 4 != class_count:
            return END_TO_END
    if class_count is not None:
        if rows == 4 + class_count:
            return SCORES
        if columns == 5 + class_count:
            return OBJECTNESS
    if columns == rows:
        return ''
    return SCORES if rows < columns else OBJECTNESS


def _not_a_detector(shape: Sequence[int]) -> str:
    return (
        f'Its output has the shape {list(shape)}, which is not that of a YOLO detector: '
        '[1, 4 + classes, N], [1, N, 5 + classes] or [1, N, 6]. Export it again as a detector, '
        'with its boxes decoded.'
    )


def _unfit(shape: Sequence[int], told: str) -> str:
    return (
        f"Its output has the shape {list(shape)}, which does not fit the layout '{told}'. "
        "Set the parameter 'layout' to 'auto'."
    )


def candidates_in(output: npt.NDArray[Any], layout: str, confidence: float) -> Candidates:
    """
    Decode the output of a network to boxes with a score of at least `confidence`.

    Non-finite values and boxes without an area are left out.

    Parameters
    ----------
    output
        The output, in the shape of the layout: [1, ...].
    layout
        One of `LAYOUTS`, but not `AUTO`.
    confidence
        The score threshold, 0 to 1.

    """
    table = np.asarray(output[0], dtype=np.float32)
    if layout == END_TO_END:
        boxes, scores, classes = table[:, :4], table[:, 4], table[:, 5]
        chosen = scores >= confidence
        boxes, scores = boxes[chosen], scores[chosen]
        numbers = np.nan_to_num(classes[chosen]).astype(np.int64)
    elif layout == OBJECTNESS:
        table = table[table[:, 4] >= confidence]
        boxes, scores, numbers = _best(table[:, :4], table[:, 5:] * table[:, 4:5], confidence)
    else:
        every = table[4:]
        chosen = every.max(axis=0) >= confidence
        boxes, scores, numbers = _best(table[:4, chosen].T, every[:, chosen].T, confidence)
    is_real = np.isfinite(boxes).all(axis=1) & np.isfinite(scores)
    is_real &= (boxes[:, 2] > boxes[:, 0]) & (boxes[:, 3] > boxes[:, 1]) & (numbers >= 0)
    return Candidates(boxes[is_real], scores[is_real], numbers[is_real])


def _best(
    boxes: Array, scores: Array, confidence: float
) -> tuple[Array, Array, npt.NDArray[np.int64]]:
    """Convert centres and sizes (n, 4) to corners, and select the best of the scores (n, m)."""
    numbers = scores.argmax(axis=1)
    best = scores[np.arange(len(scores)), numbers]
    chosen = best >= confidence
    half = boxes[chosen, 2:] / 2.0
    corners = np.concatenate([boxes[chosen, :2] - half, boxes[chosen, :2] + half], axis=1)
    return corners, best[chosen], numbers[chosen].astype(np.int64)


def suppressed(found: Candidates, iou: float) -> Candidates:
    """
    Suppress duplicate boxes by greedy non-maximum suppression (NMS) within each class.

    A box is dropped if its intersection over union (IoU) with a better one of its class is larger
    than `iou`.

    Parameters
    ----------
    found
        The boxes, in any order.
    iou
        The IoU threshold.

    Returns
    -------
    Candidates
        The remaining boxes, by decreasing score; at most 300.

    """
    order = np.argsort(-found.scores, kind='stable')[:_MOST_CANDIDATES]
    boxes, classes = found.boxes_px[order].astype(np.float64), found.classes[order]
    areas = (boxes[:, 2] - boxes[:, 0]) * (boxes[:, 3] - boxes[:, 1])
    left = np.ones(len(order), dtype=bool)
    kept: list[int] = []
    for number in range(len(order)):
        if not left[number]:
            continue
        kept.append(number)
        if len(kept) == _MOST:
            break
        low = np.maximum(boxes[number, :2], boxes[:, :2])
        high = np.minimum(boxes[number, 2:], boxes[:, 2:])
        shared = np.prod(np.clip(high - low, 0.0, None), axis=1)
        is_same = shared / (areas + areas[number] - shared) > iou
        left &= ~(is_same & (classes == classes[number]))
    chosen = order[kept]
    return Candidates(found.boxes_px[chosen], found.scores[chosen], found.classes[chosen])


def box_of(row: Array) -> Box:
    """
    Convert a row of an array of boxes to a tuple of numbers.

    Parameters
    ----------
    row
        Left, top, right and bottom (4,) in pixels.

    """
    left, top, right, bottom = (float(edge) for edge in row)
    return left, top, right, bottom
