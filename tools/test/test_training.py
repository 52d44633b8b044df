# SPDX-License-Identifier: Apache-2.0
"""Pictures for the training of the detector, and how its detections are judged."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
import sys

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / 'training'))

from batches import Album, letterboxed, moved, targets  # noqa: E402
from boxes import assignment, Cells, corners, decoded, iou, suppressed  # noqa: E402
from home_colours import band, HELD_OUT, TRAINING  # noqa: E402
from homes import home_of, random_home  # noqa: E402
from humanoid_simulation.camera.pinhole import Pinhole  # noqa: E402
from humanoid_simulation.scene import load_scene  # noqa: E402
from humanoid_simulation.scene.objects import ObjectInstance, thing_of  # noqa: E402
from labels import labels_of, Seen, silhouette_area_px  # noqa: E402
from metrics import Counted, quality  # noqa: E402
import pictures  # noqa: E402
from pictures import CLASSES, COLUMNS  # noqa: E402

BALL, CUBE = CLASSES.index('ball'), CLASSES.index('cube')
CAMERA = Pinhole(320, 240, np.radians(60.0))


def label(kind=BALL, box=(10, 10, 30, 30), visible=1.0, pixels=400.0, distance_m=1.0):
    """Return one row of labels."""
    return np.array([[kind, *box, visible, pixels, distance_m]], np.float32)


def thing_at(kind: str, position_m: tuple[float, ...]) -> Seen:
    """Return a thing in front of the camera."""
    made = thing_of(ObjectInstance(kind, kind, 'red', (1.0, 0.0, 0.0), (0.0, 0.0, 0.0)))
    return Seen(made, CLASSES.index(kind), np.array(position_m), np.eye(3))


@pytest.fixture(scope='module')
def cells() -> Iterator[Cells]:
    """Return the cells of a picture."""
    yield Cells.of(128, 160)


@pytest.mark.parametrize('position_m', [(0.0, 0.0, 1.0), (0.9, 0.2, 1.0), (0.0, 0.0, 2.5)])
def test_silhouette_of_a_ball_is_a_disc(position_m: tuple[float, ...]) -> None:
    """The area that a ball would cover is that of its projection, also beyond the border."""
    area_px = silhouette_area_px(thing_at('ball', position_m), CAMERA)
    radius_px = 0.05 / position_m[2] * CAMERA.focal_px
    # Off the axis a ball is an ellipse, larger by the inverse of the cosine.
    stretched = (1.0 + (position_m[0] ** 2 + position_m[1] ** 2) / position_m[2] ** 2) ** 0.5
    assert area_px == pytest.approx(np.pi * radius_px**2 * stretched, rel=0.04)


def test_label_has_the_visible_part_of_a_thing() -> None:
    """Half of a ball that something hides is labelled as half visible, with its own box."""
    y, x = np.mgrid[:240, :320]
    radius_px = 0.05 * CAMERA.focal_px
    disc = (x - 159.5) ** 2 + (y - 119.5) ** 2 < radius_px**2
    owners = np.where(disc & (x < 160), 7, -1).astype(np.int32)
    rows = labels_of(owners, {7: thing_at('ball', (0.0, 0.0, 1.0))}, CAMERA)
    assert rows[0, pictures.CLASS] == BALL
    assert rows[0, pictures.BOX] == pytest.approx([149, 109, 160, 131], abs=1.0)
    assert rows[0, pictures.VISIBLE] == pytest.approx(0.5, abs=0.06)
    assert rows[0, pictures.DISTANCE] == pytest.approx(1.0)


def test_homes_depend_on_the_seed_alone() -> None:
    """The same seed gives the same home, another one another."""
    first, same, other = (random_home(np.random.default_rng(seed)) for seed in (5, 5, 6))
    assert first == same
    assert first != other
    assert first.scene.objects


def test_nothing_held_out_is_trained_on() -> None:
    """Colours and lights of the two splits come from bands that do not overlap."""
    values = {
        split: np.array([band(np.random.default_rng(seed), split) for seed in range(300)])
        for split in (TRAINING, HELD_OUT)
    }
    bands = {split: set((8 * value).astype(int)) for split, value in values.items()}
    assert bands == {TRAINING: {0, 2, 4, 6}, HELD_OUT: {1, 3, 5, 7}}


def test_apartment_can_be_photographed_as_it_is() -> None:
    """The places that furniture takes are known, and which room one is in."""
    home = home_of(load_scene('apartment'))
    assert any(each.is_near(-0.15, 2.1, 0.0) for each in home.footprints)
    assert home.bounds_m(0.0, 2.0) == (-0.7, 2.7, 0.7, 4.2)


def test_crop_cuts_labels() -> None:
    """What a crop cuts off is no longer visible, and its pixels do not count."""
    seen = moved(label(box=(10, 10, 30, 30)), 2.0, np.array([20.0, 0.0]), (100, 100))
    assert seen[0, pictures.BOX] == pytest.approx([0, 20, 20, 60])
    assert seen[0, pictures.VISIBLE] == pytest.approx(0.5)
    assert seen[0, pictures.PIXELS] == pytest.approx(0.5 * 4 * 400)
    assert len(moved(label(), 1.0, np.array([40.0, 0.0]), (100, 100))) == 0


def test_every_thing_that_is_clear_is_learned_by_a_cell(cells: Cells) -> None:
    """Boxes of all sizes, and wherever they are, have cells; tiny ones too."""
    generator = np.random.default_rng(3)
    for _ in range(200):
        edges = generator.uniform(3.0, 100.0, 2)
        low = generator.uniform(0.0, 1.0, 2) * np.maximum(np.array([160, 128]) - edges, 0.0)
        box = np.array([[*low, *(low + edges)]], np.float32)
        assert (assignment(box, cells) == 0).any()


def test_smaller_box_wins(cells: Cells) -> None:
    """Where a cell could learn two boxes, it learns the smaller one."""
    boxes = np.array([[20, 20, 46, 46], [28, 28, 38, 38]], np.float32)
    chosen = assignment(boxes, cells)
    at_middle = np.abs(cells.centres_px - 33.0).max(axis=1) < 2.1
    assert set(chosen[at_middle & (cells.strides_px == 4)]) == {1}


def test_nothing_is_learned_where_a_thing_is_hardly_visible(cells: Cells) -> None:
    """A thing of which little is seen is neither a thing nor background."""
    _, classes, weights = targets(label(visible=0.1), cells)
    assert (classes == -1).all()
    inside = np.abs(cells.centres_px - 20.0).max(axis=1) < 10.0
    assert (weights[inside] == 0.0).all()
    assert weights.max() == 1.0


def test_cells_can_say_each_box(cells: Cells) -> None:
    """There are outputs that mean a given box: decoding is the inverse of a formula."""
    box = np.array([33.0, 47.0, 12.0, 25.0], np.float32)
    strides = cells.strides_px[:, None]
    raw = np.concatenate(
        [(box[:2] - cells.centres_px) / strides, np.log(box[2:] / (2.0 * strides))], axis=1
    )
    assert decoded(np, raw, cells) == pytest.approx(np.tile(box, (len(raw), 1)), rel=1e-4)
    assert corners(box) == pytest.approx([27.0, 34.5, 39.0, 59.5])


def test_suppression_keeps_the_best_box_of_each_class() -> None:
    """Of boxes that overlap the best one stays; another class is another thing."""
    boxes = np.array([[0, 0, 10, 10], [1, 0, 11, 10], [50, 50, 60, 60]], np.float32)
    scores = np.zeros((3, len(CLASSES)), np.float32)
    scores[:, BALL] = 0.6, 0.8, 0.5
    scores[0, CUBE] = 0.7
    kept, kinds, values = suppressed(boxes, scores, 0.1, 0.5)
    assert list(zip(kinds, values.round(1))) == [(BALL, 0.8), (CUBE, 0.7), (BALL, 0.5)]
    assert kept[0] == pytest.approx(boxes[1])
    assert iou(boxes[:1], boxes[1:2])[0, 0] == pytest.approx(90 / 110)


def test_quality_counts_each_thing_once() -> None:
    """A second detection of a thing is wrong; one of a thing that need not be found is not."""
    truth = [np.concatenate([label(), label(box=(60, 10, 80, 30), visible=0.1)])]
    boxes = np.array([[10, 10, 30, 30], [11, 10, 31, 30], [60, 10, 80, 30]], np.float32)
    found = [(boxes, np.full(3, BALL), np.array([0.9, 0.8, 0.7], np.float32))]
    result = quality(truth, found, BALL, Counted())
    assert (result.things, result.recall, result.precision) == (1, 1.0, 0.5)
    assert result.average_precision == pytest.approx(1.0)


def test_average_precision_of_a_known_curve() -> None:
    """One hit, a miss and a hit of two things: the area is 1/2 + 1/2 * 2/3."""
    truth = [np.concatenate([label(), label(box=(60, 10, 80, 30))])]
    boxes = np.array([[10, 10, 30, 30], [100, 100, 120, 120], [60, 10, 80, 30]], np.float32)
    found = [(boxes, np.full(3, BALL), np.array([0.9, 0.8, 0.7], np.float32))]
    assert quality(truth, found, BALL, Counted()).average_precision == pytest.approx(5 / 6)


def test_shards_are_read_as_written(tmp_path: Path) -> None:
    """Pictures and labels come back; a shard that was not finished is none."""
    colors = np.random.default_rng(0).integers(0, 256, (3, 240, 320, 3)).astype(np.uint8)
    labels = (label(), np.empty((0, COLUMNS), np.float32), np.concatenate([label(), label(CUBE)]))
    assert not pictures.is_there(tmp_path, 4)
    pictures.write(tmp_path, 4, pictures.Shard(colors, labels, np.array([0, 1, 0])))
    assert pictures.is_there(tmp_path, 4)
    (shard,) = pictures.shards(tmp_path)
    assert (shard.colors == colors).all()
    assert [len(each) for each in shard.labels] == [1, 0, 2]
    assert list(shard.renderers) == [0, 1, 0]


def test_batches_depend_on_seed_and_step_alone(tmp_path: Path) -> None:
    """A training that goes on has the batches that it would have had."""
    colors = np.random.default_rng(0).integers(0, 256, (4, 240, 320, 3)).astype(np.uint8)
    pictures.write(tmp_path, 0, pictures.Shard(colors, (label(),) * 4, np.zeros(4, np.int64)))
    first, again = Album(tmp_path), Album(tmp_path)
    for step in (0, 1):
        a, b, other = first.batch(1, step), again.batch(1, step), first.batch(2, step)
        assert (a.pictures == b.pictures).all() and (a.classes == b.classes).all()
        assert (a.pictures != other.pictures).any()


def test_letterbox_adds_rows_above_and_below() -> None:
    """A picture of the camera is in the middle of the input."""
    picture, rows = letterboxed(np.full((240, 320, 3), 7, np.uint8))
    assert picture.shape == (256, 320, 3) and rows == 8
    assert (picture[8:248] == 7).all() and (picture[:8] == 114).all()
