# SPDX-License-Identifier: Apache-2.0
"""Test the detector that runs YOLO networks, with constant networks of each layout."""

from __future__ import annotations

from pathlib import Path

from humanoid_perception.detection import DetectorError
from humanoid_perception.onnx_backend import names_in_file, OnnxDetector
from humanoid_perception.onnx_testing import write_constant_network
import numpy as np
import pytest

NAMES = {'names': "{0: 'mug', 1: 'bottle', 2: 'can'}"}
PICTURE = np.zeros((240, 320, 3), np.uint8)
"""In an input of 320x320 it has bars of 40 pixels above and below."""
MUG_PX, CAN_PX = (100.0, 60.0, 140.0, 100.0), (200.0, 20.0, 230.0, 100.0)


def in_input(box_px: tuple[float, ...]) -> list[float]:
    """Return the corners of a box of the picture in the input."""
    left, top, right, bottom = box_px
    return [left, top + 40.0, right, bottom + 40.0]


def centred(corners: list[float]) -> list[float]:
    """Return centre and size of corners."""
    left, top, right, bottom = corners
    return [(left + right) / 2, (top + bottom) / 2, right - left, bottom - top]


def candidates(count: int) -> list[tuple[list[float], list[float]]]:
    """Return boxes and scores: a mug, a weaker one on it, a can on the mug, a can, and noise."""
    moved = [each + 4.0 for each in in_input(MUG_PX)]
    rows = [
        (in_input(MUG_PX), [0.9, 0.1, 0.2]),
        (moved, [0.7, 0.0, 0.1]),
        (moved, [0.0, 0.0, 0.6]),
        (in_input(CAN_PX), [0.0, 0.1, 0.8]),
    ]
    rng = np.random.default_rng(1)
    noise = [([*rng.uniform(0, 200, 2), *rng.uniform(220, 320, 2)], [0.1, 0.2, 0.05])]
    return rows + noise * (count - len(rows))


def scores_layout(count: int = 2100) -> np.ndarray:
    rows = [centred(box) + scores for box, scores in candidates(count)]
    return np.array(rows).T[None]


def objectness_layout(count: int = 6300) -> np.ndarray:
    rows = [[*centred(box), 0.95, *scores] for box, scores in candidates(count)]
    return np.array(rows)[None]


def end_to_end_layout(count: int = 300) -> np.ndarray:
    rows = [
        [*box, max(scores), float(np.argmax(scores))]
        for number, (box, scores) in enumerate(candidates(count))
        if number != 1
    ]
    return np.array(rows)[None]


@pytest.mark.parametrize(
    ('output', 'layout', 'factor'),
    [
        (scores_layout(), 'scores', 1.0),
        (objectness_layout(), 'objectness', 0.95),
        (end_to_end_layout(), 'end_to_end', 1.0),
    ],
    ids=['v8', 'v5', 'v10'],
)
@pytest.mark.parametrize('kind', ['float32', 'float16', 'uint8'])
def test_boxes_of_each_layout_are_exact(tmp_path: Path, output, layout, factor, kind):
    path = write_constant_network(tmp_path / 'm.onnx', output, metadata=NAMES, kind=kind)
    detector = OnnxDetector(str(path))
    assert detector.layout == layout
    found = detector.detect(PICTURE, confidence=0.4, iou=0.5)
    assert [each.class_id for each in found] == ['mug', 'can', 'can']
    scores = [each.score / factor for each in found]
    assert scores == pytest.approx([0.9, 0.8, 0.6])
    assert found[0].box_px == pytest.approx(MUG_PX, abs=1e-3)
    assert found[1].box_px == pytest.approx(CAN_PX, abs=1e-3)


def test_a_picture_of_another_size_is_scaled(tmp_path: Path):
    path = write_constant_network(tmp_path / 'm.onnx', scores_layout(), metadata=NAMES)
    picture = np.zeros((480, 640, 3), np.uint8)
    found = OnnxDetector(str(path)).detect(picture, confidence=0.75)
    assert found[0].box_px == pytest.approx([2.0 * edge for edge in MUG_PX], abs=1e-3)


def test_boxes_that_the_border_cuts_are_flagged(tmp_path: Path):
    outside = centred([-20.0, 100.0, 30.0, 150.0])
    rows = np.zeros((2100, 7))
    rows[0] = [*outside, 0.9, 0.0, 0.0]
    path = write_constant_network(tmp_path / 'm.onnx', rows.T[None], metadata=NAMES)
    (found,) = OnnxDetector(str(path)).detect(PICTURE)
    assert found.is_cut
    assert found.box_px == pytest.approx((0.0, 60.0, 30.0, 110.0))


def test_values_that_are_no_numbers_are_left_out(tmp_path: Path):
    output = scores_layout()
    output[0, :4, 0] = np.nan
    output[0, 4, 3] = np.inf
    path = write_constant_network(tmp_path / 'm.onnx', output, metadata=NAMES)
    found = OnnxDetector(str(path)).detect(PICTURE)
    assert [each.class_id for each in found] == ['mug', 'can']


def test_names_come_from_a_labels_file(tmp_path: Path):
    path = write_constant_network(tmp_path / 'm.onnx', scores_layout(), metadata=NAMES)
    labels = tmp_path / 'labels.txt'
    labels.write_text('Tasse\nFlasche\nDose\n')
    assert OnnxDetector(str(path), str(labels)).class_names == ('Tasse', 'Flasche', 'Dose')
    data = tmp_path / 'data.yaml'
    data.write_text('names: {0: a, 1: b, 2: c}\n')
    assert names_in_file(str(data)) == ['a', 'b', 'c']


def test_an_input_of_any_size_is_as_small_as_the_picture_allows(tmp_path: Path):
    output = np.zeros((1, 7, 100))
    path = write_constant_network(
        tmp_path / 'm.onnx', output, (1, 3, 'height', 'width'), {**NAMES, 'imgsz': '[640, 640]'}
    )
    assert OnnxDetector(str(path), input_size_px=160).detect(PICTURE) == []


def refusal(path: Path | str, **options) -> str:
    """Return why a model is refused."""
    with pytest.raises(DetectorError) as refused:
        OnnxDetector(str(path), **options)
    text = str(refused.value)
    assert '\n' not in text
    assert text.endswith('.')
    return text


def test_a_missing_file_is_refused(tmp_path: Path):
    assert "none.onnx' not found" in refusal(tmp_path / 'none.onnx')


def test_a_file_that_was_cut_is_refused(tmp_path: Path):
    path = write_constant_network(tmp_path / 'm.onnx', scores_layout(), metadata=NAMES)
    path.write_bytes(path.read_bytes()[:5000])
    assert 'cannot be loaded' in refusal(path)
    path.write_bytes(b'')
    assert 'cannot be loaded' in refusal(path)


@pytest.mark.parametrize(
    ('shape', 'output', 'metadata', 'part'),
    [
        ((1, 3, 320, 320), np.zeros((1, 1000)), {}, 'not that of a YOLO detector'),
        ((1, 1, 320, 320), scores_layout(8), {}, 'a detector takes one image'),
        ((8, 3, 320, 320), scores_layout(8), {}, 'a detector takes one image'),
        ((1, 3, 320), scores_layout(8), {}, 'a detector takes one image'),
        ((1, 3, 320, 320), scores_layout(), {'task': 'segment'}, 'made for segmentation'),
        ((1, 3, 320, 320), scores_layout(), {'names': "{0: 'mug'}"}, 'names 1 classes'),
    ],
)  # fmt: skip
def test_what_is_no_detector_is_refused(tmp_path: Path, shape, output, metadata, part):
    path = write_constant_network(tmp_path / 'm.onnx', output, shape, metadata)
    assert part in refusal(path)


def test_a_labels_file_that_does_not_fit_is_refused(tmp_path: Path):
    path = write_constant_network(tmp_path / 'm.onnx', scores_layout(), metadata=NAMES)
    assert 'cannot be read' in refusal(path, labels_file=str(tmp_path / 'none.txt'))
    labels = tmp_path / 'labels.yaml'
    for text in ('names: [a', 'names: 2026-13-01', '[' * 5000):
        labels.write_text(text)
        assert 'cannot be read' in refusal(path, labels_file=str(labels))
    for text in ('', 'nams: [a, b]', 'names: 3', 'names: {first: a}'):
        labels.write_text(text)
        assert "has no names. Give one per line, or a YAML list 'names'" in refusal(
            path, labels_file=str(labels)
        )
    labels = tmp_path / 'labels.txt'
    labels.write_text('only one\n')
    assert 'names 1 classes' in refusal(path, labels_file=str(labels))
    labels.write_text('\n')
    assert 'has no names' in refusal(path, labels_file=str(labels))


def test_a_layout_that_does_not_fit_is_refused(tmp_path: Path):
    path = write_constant_network(tmp_path / 'm.onnx', np.zeros((1, 7, 100)), metadata=NAMES)
    assert "does not fit the layout 'end_to_end'" in refusal(path, layout='end_to_end')
