# SPDX-License-Identifier: Apache-2.0
"""
Batches to train on: crops around things, and whole pictures, changed at random.

A batch depends on the seed, the number of its step and the pictures alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from boxes import assignment, Cells, covered
import cv2
from network import HEIGHT_PX, WIDTH_PX
import numpy as np
from numpy.typing import NDArray
import pictures
from pictures import BOX, CLASS, COLUMNS, Labels, PIXELS, VISIBLE

Color = NDArray[np.uint8]
Array = NDArray[np.float32]

CROP_PX, CROPS = 128, 12
WHOLE = 3
EVERY_WHOLE = 4
"""Every so manieth batch has whole pictures."""
LEAST_VISIBLE, LEAST_PIXELS, LEAST_EDGE_PX = 0.25, 14, 3.0
"""What is less visible is neither a thing nor background: nothing is learned there."""
BORDER = 114
"""What is beyond the picture, as usual for YOLO."""


@dataclass(frozen=True, eq=False)
class Batch:
    """Pictures, and what each cell should say."""

    pictures: Color
    """(n, height, width, 3)"""
    boxes: Array
    """(n, cells, 4) x1, y1, x2, y2; anything where nothing is"""
    classes: NDArray[np.int32]
    """(n, cells) -1 where nothing is"""
    weights: Array
    """(n, cells) 0 where nothing can be learned, else 1"""


class Album:
    """
    All pictures of a folder; more of them can be added while it is used.

    Parameters
    ----------
    folder
        The folder of the shards, which is read at once.

    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._read: set[int] = set()
        self._items: list[tuple[Color, Labels]] = []
        self.refresh()

    def refresh(self) -> int:
        """Add the shards that were written since; return how many pictures there are."""
        for number in pictures.numbers(self._folder):
            if number not in self._read:
                shard = pictures.read(self._folder, number)
                self._items += list(zip(shard.colors, shard.labels))
                self._read.add(number)
        return len(self._items)

    def batch(self, seed: int, step: int) -> Batch:
        """
        Make the batch of a step: whole pictures at every `EVERY_WHOLE`-th step, otherwise crops.

        Parameters
        ----------
        seed, step
            The seed of the training, and the number of the step: together they seed the batch.

        """
        generator = np.random.default_rng([seed, step])
        if step % EVERY_WHOLE == 0:
            height_px, width_px, count = HEIGHT_PX, WIDTH_PX, WHOLE
        else:
            height_px, width_px, count = CROP_PX, CROP_PX, CROPS
        cells = _cells(height_px, width_px)
        rows = []
        for number in generator.integers(len(self._items), size=count):
            color, labels = self._items[int(number)]
            view = _view(generator, color, labels, (height_px, width_px))
            rows.append((spoilt(generator, view[0]), *targets(view[1], cells)))
        return Batch(*(np.stack(column) for column in zip(*rows)))


_known: dict[tuple[int, int], Cells] = {}


def _cells(height_px: int, width_px: int) -> Cells:
    """Return the cells for a size, computed once."""
    key = (height_px, width_px)
    if key not in _known:
        _known[key] = Cells.of(*key)
    return _known[key]


def _view(
    generator: np.random.Generator, color: Color, labels: Labels, size_px: tuple[int, int]
) -> tuple[Color, Labels]:
    """Return a part of a picture in a size, perhaps zoomed and mirrored, and its labels."""
    height_px, width_px = size_px
    zoom = 1.0
    is_crop = height_px < color.shape[0]
    if generator.random() < 0.3:
        zoom = float(generator.uniform(0.75, 1.5) if is_crop else generator.uniform(0.85, 1.2))
    span = np.array([width_px, height_px]) / zoom
    whole = np.array([color.shape[1], color.shape[0]])
    middle = whole / 2 + generator.normal(0, 8, 2)
    if is_crop:
        middle = generator.uniform(0, 1, 2) * whole
        if len(labels) and generator.random() < 0.9:
            box = labels[int(generator.integers(len(labels))), BOX]
            middle = (box[:2] + box[2:]) / 2 + generator.uniform(-0.4, 0.4, 2) * span
        middle = np.clip(middle, span / 2 - 6, whole - span / 2 + 6)
    low = np.rint(middle - span / 2)
    affine = np.array([[zoom, 0.0, -zoom * low[0]], [0.0, zoom, -zoom * low[1]]])
    affine[:, 2] += (zoom - 1) / 2  # whole coordinates are the centres of pixels
    view = cv2.warpAffine(
        np.ascontiguousarray(color), affine, (width_px, height_px),
        flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT, borderValue=(BORDER,) * 3,
    )  # fmt: skip
    seen = moved(labels, zoom, low, (width_px, height_px))
    if generator.random() < 0.5:
        view = view[:, ::-1]
        seen[:, 1], seen[:, 3] = width_px - seen[:, 3], width_px - seen[:, 1]
    return np.ascontiguousarray(view), seen


def moved(
    labels: Labels, zoom: float, low_px: NDArray[np.float64], size_px: tuple[int, int]
) -> Labels:
    """
    Transform labels to a part of a picture.

    What is cut off is no longer visible: the part that is and the number of pixels shrink.

    Parameters
    ----------
    labels
        The labels (n, 8) in the picture.
    zoom
        How many pixels of the part are one of the picture, across and down.
    low_px
        The upper left corner (2,) x, y of the part in the picture.
    size_px
        Width and height of the part, in its own pixels.

    Returns
    -------
    Labels
        Those of what is left in the part (m, 8), in its own pixels.

    """
    seen = labels.copy()
    whole = zoom * (labels[:, BOX] - np.tile(low_px, 2))
    seen[:, BOX] = np.clip(whole, 0.0, np.tile(size_px, 2))
    edges = seen[:, 3:5] - seen[:, 1:3]
    share = edges.prod(axis=1) / np.maximum((whole[:, 2:] - whole[:, :2]).prod(axis=1), 1e-6)
    seen[:, VISIBLE] *= share
    seen[:, PIXELS] *= share * zoom**2
    return np.asarray(seen[(edges > 0.5).all(axis=1)], dtype=np.float32)


def targets(labels: Labels, cells: Cells) -> tuple[Array, NDArray[np.int32], Array]:
    """
    Compute what each cell should predict.

    Parameters
    ----------
    labels
        The labels (m, 8) of the picture.
    cells
        The cells of the network for a picture of this size.

    Returns
    -------
    boxes : Array
        (n, 4) x1, y1, x2, y2 in pixels; anything where nothing is.
    classes : NDArray
        (n,), -1 where nothing is.
    weights : Array
        (n,), 0 where nothing can be learned, else 1.

    """
    is_clear = learnable(labels)
    clear, vague = labels[is_clear], labels[~is_clear]
    chosen = assignment(clear[:, BOX], cells)
    padded = np.concatenate([clear, np.zeros((1, COLUMNS), np.float32)])[chosen]
    classes = np.where(chosen < 0, -1, padded[:, CLASS]).astype(np.int32)
    is_vague = covered(vague[:, BOX], cells) if len(vague) else np.zeros(len(chosen), bool)
    weights = np.where(is_vague & (chosen < 0), 0.0, 1.0).astype(np.float32)
    return padded[:, BOX], classes, weights


def learnable(labels: Labels) -> NDArray[np.bool_]:
    """
    Select the things that are visible enough to be learned.

    Parameters
    ----------
    labels
        The labels (n, 8) of a picture.

    Returns
    -------
    NDArray
        Whether each is (n,).

    """
    edges = labels[:, 3:5] - labels[:, 1:3]
    return np.asarray(
        (labels[:, VISIBLE] >= LEAST_VISIBLE)
        & (labels[:, PIXELS] >= LEAST_PIXELS)
        & (edges.min(axis=1, initial=1e9) >= LEAST_EDGE_PX)
    )


def spoilt(generator: np.random.Generator, picture: Color) -> Color:
    """
    Augment a picture with other brightness, contrast, tint, blur, and noise like a camera's.

    Parameters
    ----------
    generator
        The source of random numbers.
    picture
        The picture (height, width, 3), which is not changed.

    """
    if generator.random() < 0.8:
        gain = generator.uniform(0.8, 1.2) * generator.uniform(0.94, 1.06, 3)
        shift = generator.uniform(-20, 20)
        table = np.arange(256)[:, None] * gain + shift
        if generator.random() < 0.4:
            table = 255 * (np.clip(table, 0, 255) / 255) ** generator.uniform(0.75, 1.3)
        table = np.clip(np.rint(table), 0, 255).astype(np.uint8)
        picture = np.asarray(cv2.LUT(picture, table[None]), dtype=np.uint8)
    if generator.random() < 0.12:
        blurred = cv2.GaussianBlur(picture, (3, 3), generator.uniform(0.3, 0.8))
        picture = np.asarray(blurred, dtype=np.uint8)
    if generator.random() < 0.4:
        deviation = generator.uniform(0.0, 7.0)
        noise = generator.standard_normal(picture.shape, np.float32) * deviation
        picture = np.clip(np.rint(picture + noise), 0, 255).astype(np.uint8)
    return np.asarray(picture, dtype=np.uint8)


def letterboxed(picture: Color) -> tuple[Color, int]:
    """
    Pad a picture of 320x240 above and below to the input size of the network.

    Parameters
    ----------
    picture
        The picture (240, 320, 3).

    Returns
    -------
    Color, int
        The input (256, 320, 3), and the number of rows above the picture.

    """
    rows = (HEIGHT_PX - picture.shape[0]) // 2
    below = HEIGHT_PX - picture.shape[0] - rows
    borders = ((rows, below), (0, 0), (0, 0))
    return np.pad(picture, borders, constant_values=BORDER), rows


def stacked(colors: Sequence[Color]) -> Color:
    """
    Pad several pictures to a batch of inputs.

    Parameters
    ----------
    colors
        The pictures (240, 320, 3).

    Returns
    -------
    Color
        The inputs (n, 256, 320, 3).

    """
    return np.stack([letterboxed(each)[0] for each in colors])
