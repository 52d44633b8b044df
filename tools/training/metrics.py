# SPDX-License-Identifier: Apache-2.0
"""How well detections fit what is visible: average precision at an IoU of 0.5."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from boxes import iou
import numpy as np
from numpy.typing import NDArray
from pictures import BOX, CLASS, DISTANCE, Labels, PIXELS, VISIBLE

Array = NDArray[np.float32]
Detections = tuple[Array, NDArray[np.int64], Array]
"""Boxes (n, 4) x1, y1, x2, y2; classes (n,); scores (n,)"""


@dataclass(frozen=True)
class Counted:
    """Which things must be found. The others may be found: that counts neither way."""

    nearest_m: float = 0.5
    farthest_m: float = 3.0
    visible: float = 0.3
    pixels: float = 30.0

    def of(self, labels: Labels) -> NDArray[np.bool_]:
        """
        Select the things that must be found.

        Parameters
        ----------
        labels
            The labels (n, 8) of a picture.

        Returns
        -------
        NDArray
            Whether each must be found (n,).

        """
        distance_m = labels[:, DISTANCE]
        return np.asarray(
            (distance_m >= self.nearest_m)
            & (distance_m < self.farthest_m)
            & (labels[:, VISIBLE] >= self.visible)
            & (labels[:, PIXELS] >= self.pixels)
        )


@dataclass(frozen=True)
class Quality:
    """How well one class is detected."""

    average_precision: float
    """NaN if no thing of the class is to be found."""
    things: int
    precision: float
    """Of detections above a score."""
    recall: float


def quality(
    truth: Sequence[Labels],
    detections: Sequence[Detections],
    kind: int,
    counted: Counted,
    least_iou: float = 0.5,
    score: float = 0.4,
) -> Quality:
    """
    Compute how well a class is detected.

    Detections take things in the order of their scores, each the counted one that it fits best.
    The average precision is the area below the curve of precision, made to fall, over recall.

    Parameters
    ----------
    truth
        For each picture what is visible.
    detections
        For each picture what was detected.
    kind
        The number of the class.
    counted
        Which things must be found.
    least_iou
        How well boxes must fit.
    score
        That above which precision and recall are computed.

    """
    scores: list[float] = []
    hits: list[bool] = []
    things = 0
    for labels, (boxes, kinds, confidences) in zip(truth, detections):
        labels = labels[labels[:, CLASS] == kind]
        is_counted = counted.of(labels)
        things += int(is_counted.sum())
        mine = kinds == kind
        for confidence, hit in _matches(
            boxes[mine], confidences[mine], labels[:, BOX], is_counted, least_iou
        ):
            scores.append(confidence)
            hits.append(hit)
    return _summary(np.array(scores), np.array(hits, dtype=bool), things, score)


def _matches(
    boxes: Array,
    confidences: Array,
    truth: Array,
    is_counted: NDArray[np.bool_],
    least_iou: float,
) -> list[tuple[float, bool]]:
    """Return score and success of each detection that counts, in one picture."""
    matched: list[tuple[float, bool]] = []
    is_free = is_counted.copy()
    overlaps = iou(boxes, truth) if len(truth) else np.zeros((len(boxes), 0), np.float32)
    for number in np.argsort(-confidences, kind='stable'):
        fits = overlaps[number] >= least_iou
        if (fits & is_free).any():
            is_free[np.where(fits & is_free, overlaps[number], -1.0).argmax()] = False
            matched.append((float(confidences[number]), True))
        elif not (fits & ~is_counted).any():
            matched.append((float(confidences[number]), False))
    return matched


def _summary(
    scores: NDArray[np.float64], hits: NDArray[np.bool_], things: int, score: float
) -> Quality:
    """Return the quality of detections."""
    if things == 0:
        return Quality(float('nan'), 0, float('nan'), float('nan'))
    order = np.argsort(-scores, kind='stable')
    found = np.cumsum(hits[order])
    precision = found / np.arange(1, len(order) + 1)
    recall = found / things
    falling = np.maximum.accumulate(precision[::-1])[::-1]
    area = float(np.sum(np.diff(recall, prepend=0.0) * falling))
    above = scores >= score
    correct = int(hits[above].sum())
    return Quality(area, things, correct / max(int(above.sum()), 1), correct / things)


def mean_average_precision(qualities: Sequence[Quality]) -> float:
    """
    Average the average precision over the classes of which there are things.

    Parameters
    ----------
    qualities
        One for each class.

    """
    return float(np.nanmean([each.average_precision for each in qualities]))
