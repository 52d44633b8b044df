# SPDX-License-Identifier: Apache-2.0
"""Test letterbox, layouts and suppression."""

from __future__ import annotations

from humanoid_perception.detection import DetectorError
from humanoid_perception.yolo import Candidates, layout_of, Letterbox, letterbox_size, suppressed
import numpy as np
import pytest


@pytest.mark.parametrize(
    ('picture', 'size'),
    [
        ((240, 320), (320, 320)),
        ((480, 640), (256, 320)),
        ((37, 91), (64, 96)),
        ((9, 300), (32, 32)),
    ],
)
def test_a_letterbox_is_undone_exactly(picture: tuple[int, int], size: tuple[int, int]):
    letterbox = Letterbox.of(picture, size)
    color = np.full((*picture, 3), 200, np.uint8)
    shown = letterbox.apply(color, size)
    assert shown.shape == (*size, 3)
    rows, columns = np.nonzero((shown == 200).all(axis=2))
    inside = np.array([[columns.min(), rows.min(), columns.max() + 1, rows.max() + 1]], np.float32)
    assert letterbox.undo(inside)[0] == pytest.approx([0, 0, picture[1], picture[0]], abs=1e-3)
    assert (shown[0, 0] == (200 if rows.min() == 0 and columns.min() == 0 else 114)).all()


def test_the_input_is_as_small_as_the_picture_allows():
    assert letterbox_size((240, 320), 320, 32) == (256, 320)
    assert letterbox_size((720, 1280), 640, 32) == (384, 640)
    assert letterbox_size((10, 1000), 320, 32) == (32, 320)


@pytest.mark.parametrize(
    ('shape', 'classes', 'metadata', 'expected'),
    [
        ((1, 84, 8400), 80, {}, ('scores', 80)),
        ((1, 84, 8400), None, {}, ('scores', 80)),
        ((1, 25200, 85), 80, {}, ('objectness', 80)),
        ((1, 300, 6), 80, {}, ('end_to_end', 0)),
        ((1, 300, 6), None, {'end2end': 'True'}, ('end_to_end', 0)),
        ((1, 25200, 6), 1, {}, ('objectness', 1)),
        ((1, 5, 2100), 1, {}, ('scores', 1)),
        ((1, 100, 6), 96, {}, ('scores', 96)),
    ],
)
def test_layouts_are_told_apart(shape, classes, metadata, expected):
    assert layout_of(shape, classes, metadata) == expected


@pytest.mark.parametrize('shape', [(1, 1000), (2, 84, 100), (1, 4, 4), (1, 0, 6), (1, 3, 2)])
def test_other_shapes_are_refused(shape):
    with pytest.raises(DetectorError, match='not that of a YOLO detector'):
        layout_of(shape, None, {})


def test_suppression_agrees_with_the_definition():
    rng = np.random.default_rng(3)
    low = rng.uniform(0, 200, (250, 2))
    boxes = np.concatenate([low, low + rng.uniform(10, 80, (250, 2))], axis=1).astype(np.float32)
    scores, classes = rng.random(250).astype(np.float32), rng.integers(0, 3, 250)
    kept = suppressed(Candidates(boxes, scores, classes), 0.45)
    expected: list[int] = []
    for number in np.argsort(-scores):
        if all(
            classes[number] != classes[other] or iou(boxes[number], boxes[other]) <= 0.45
            for other in expected
        ):
            expected.append(number)
    assert kept.boxes_px == pytest.approx(boxes[expected])
    assert list(kept.classes) == list(classes[expected])
    assert (np.diff(kept.scores) <= 0).all()


def iou(a: np.ndarray, b: np.ndarray) -> float:
    """Return the intersection over union of two boxes."""
    shared = np.prod(np.clip(np.minimum(a[2:], b[2:]) - np.maximum(a[:2], b[:2]), 0, None))
    return float(shared / (np.prod(a[2:] - a[:2]) + np.prod(b[2:] - b[:2]) - shared))
