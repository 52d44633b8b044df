# SPDX-License-Identifier: Apache-2.0
"""Cells of the network's outputs, the boxes that they predict, and what they should predict."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from network import LARGEST_EXPONENT, SIZE_OF_STRIDE, STRIDES
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float32]

RADIUS_CELLS = 1.1
"""A cell learns a box whose centre is nearer than so many strides, across and down."""
_SIZES_PX = ((0.0, 30.0), (20.0, 72.0), (48.0, 1e9))
"""The longer edges of boxes that the cells of each stride learn."""


@dataclass(frozen=True, eq=False)
class Cells:
    """All cells of all strides for pictures of a size, in the order of the outputs."""

    centres_px: Array
    """(n, 2) x and y"""
    strides_px: Array
    """(n,)"""
    sizes_px: Array
    """(n, 2) least and greatest longer edge of what they learn"""

    @classmethod
    def of(cls, height_px: int, width_px: int) -> Cells:
        """
        Lay out the cells for pictures of a size.

        Parameters
        ----------
        height_px, width_px
            The size, in multiples of the largest stride.

        """
        centres, strides, sizes = [], [], []
        for stride, limits in zip(STRIDES, _SIZES_PX):
            x, y = np.meshgrid(np.arange(width_px // stride), np.arange(height_px // stride))
            at = np.stack([x, y], axis=-1).reshape(-1, 2)
            centres.append((at + 0.5) * stride)
            strides.append(np.full(len(at), stride))
            sizes.append(np.tile(limits, (len(at), 1)))
        return cls(
            np.concatenate(centres).astype(np.float32),
            np.concatenate(strides).astype(np.float32),
            np.concatenate(sizes).astype(np.float32),
        )


def decoded(xp: Any, raw: Any, cells: Cells) -> Any:
    """
    Decode the boxes that the outputs of the network mean.

    Parameters
    ----------
    xp
        numpy or jax.numpy.
    raw
        The first four outputs of each cell (..., n, 4).
    cells
        Where the cells are.

    Returns
    -------
    Any
        Boxes (..., n, 4): centre x, y, width and height in pixels.

    """
    strides = cells.strides_px[:, None]
    centres = cells.centres_px + raw[..., :2] * strides
    exponents = xp.clip(raw[..., 2:4], -LARGEST_EXPONENT, LARGEST_EXPONENT)
    return xp.concatenate([centres, xp.exp(exponents) * (SIZE_OF_STRIDE * strides)], axis=-1)


def assignment(boxes: Array, cells: Cells) -> NDArray[np.int32]:
    """
    Assign to each cell the box that it learns: the smallest one of its sizes with a near centre.

    Parameters
    ----------
    boxes
        (m, 4) x1, y1, x2, y2 in pixels.
    cells
        The cells.

    Returns
    -------
    NDArray
        The number of the box (n,), or -1.

    """
    if len(boxes) == 0:
        return np.full(len(cells.centres_px), -1, dtype=np.int32)
    centres = (boxes[:, :2] + boxes[:, 2:]) / 2
    edges = boxes[:, 2:] - boxes[:, :2]
    away = np.abs(cells.centres_px[:, None] - centres[None]).max(axis=2)
    longer = edges.max(axis=1)
    fits = (
        (away < RADIUS_CELLS * cells.strides_px[:, None])
        & (longer[None] >= cells.sizes_px[:, :1])
        & (longer[None] <= cells.sizes_px[:, 1:])
    )
    area = np.where(fits, edges.prod(axis=1)[None], np.inf)
    chosen = area.argmin(axis=1)
    return np.where(np.isfinite(area.min(axis=1)), chosen, -1).astype(np.int32)


def covered(boxes: Array, cells: Cells) -> NDArray[np.bool_]:
    """
    Select the cells whose centres are in a box, or less than a stride from one.

    Parameters
    ----------
    boxes
        (m, 4) x1, y1, x2, y2 in pixels.
    cells
        The cells.

    Returns
    -------
    NDArray
        Whether each cell is (n,).

    """
    x, y = cells.centres_px[:, :1], cells.centres_px[:, 1:]
    margin = cells.strides_px[:, None]
    inside = (
        (x > boxes[None, :, 0] - margin)
        & (x < boxes[None, :, 2] + margin)
        & (y > boxes[None, :, 1] - margin)
        & (y < boxes[None, :, 3] + margin)
    )
    return np.asarray(inside.any(axis=1))


def iou(a: Array, b: Array) -> Array:
    """
    Compute the intersection over union of each box with each of some others.

    Parameters
    ----------
    a, b
        Boxes (n, 4) and (m, 4): x1, y1, x2, y2.

    Returns
    -------
    Array
        (n, m), from 0 to 1.

    """
    low = np.maximum(a[:, None, :2], b[None, :, :2])
    high = np.minimum(a[:, None, 2:], b[None, :, 2:])
    shared = np.maximum(high - low, 0.0).prod(axis=2)
    areas = [np.maximum(each[:, 2:] - each[:, :2], 0.0).prod(axis=1) for each in (a, b)]
    return np.asarray(shared / np.maximum(areas[0][:, None] + areas[1][None] - shared, 1e-9))


def suppressed(
    boxes: Array, scores: Array, least_score: float, most_iou: float, most: int = 300
) -> tuple[Array, NDArray[np.int64], Array]:
    """
    Select the boxes that stay after non-maximum suppression of each class, best first.

    Parameters
    ----------
    boxes
        (n, 4) x1, y1, x2, y2.
    scores
        (n, classes).
    least_score
        What is below counts as nothing.
    most_iou
        How much boxes of one class may overlap.
    most
        How many of the best boxes are considered.

    Returns
    -------
    Array, NDArray, Array
        Boxes (m, 4), classes (m,) and scores (m,).

    """
    cell, kind = np.nonzero(scores >= least_score)
    order = np.argsort(-scores[cell, kind], kind='stable')[:most]
    cell, kind = cell[order], kind[order]
    shifted = boxes[cell] + 1e4 * kind[:, None].astype(np.float32)
    overlaps = iou(shifted, shifted)
    kept: list[int] = []
    for number in range(len(cell)):
        if not kept or overlaps[number, kept].max() <= most_iou:
            kept.append(number)
    return boxes[cell[kept]], kind[kept], scores[cell[kept], kind[kept]]


def corners(boxes: Sequence[Any] | Array) -> Array:
    """
    Convert boxes from centre and size to corners.

    Parameters
    ----------
    boxes
        (..., 4) centre x, y, width and height.

    Returns
    -------
    Array
        (..., 4) x1, y1, x2, y2.

    """
    boxes = np.asarray(boxes, dtype=np.float32)
    half = boxes[..., 2:] / 2
    return np.concatenate([boxes[..., :2] - half, boxes[..., :2] + half], axis=-1)
