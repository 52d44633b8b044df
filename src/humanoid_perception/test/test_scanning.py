# SPDX-License-Identifier: Apache-2.0
"""Test the plan of a look around, and what it has covered."""

from __future__ import annotations

import math

from humanoid_perception.scanning import Coverage, FieldOfView, head_sweep, stances
import numpy as np
import pytest

LOWER, UPPER = (-1.4, -0.6), (1.4, 0.9)
UP, DOWN = 0.15, 0.85
FIELDS = [
    FieldOfView.of(320, 240, 207.8, 207.8, 160.0, 120.0),
    FieldOfView.of(640, 480, 600.0, 600.0, 320.0, 240.0),
    FieldOfView.of(160, 120, 60.0, 60.0, 80.0, 60.0),
    FieldOfView.of(320, 240, 250.0, 260.0, 140.0, 130.0),
]


def optical(yaw: float, pitch: float) -> np.ndarray:
    """Return the rotation of a camera that is turned to the left and tilted down."""
    ahead = np.array(
        [math.cos(pitch) * math.cos(yaw), math.cos(pitch) * math.sin(yaw), -math.sin(pitch)]
    )
    right = np.array([math.sin(yaw), -math.cos(yaw), 0.0])
    return np.stack([right, np.cross(ahead, right), ahead], axis=1)


@pytest.mark.parametrize('field', FIELDS)
def test_a_sweep_sees_what_the_head_can(field: FieldOfView) -> None:
    """No gap is left between two looks, and no look is beyond the limits."""
    views = head_sweep(field, LOWER, UPPER, UP, DOWN)
    covered = Coverage(UP, min(DOWN, UPPER[1] + field.down_rad))
    yaws = np.linspace(LOWER[0], UPPER[0], 60)
    pitches = np.linspace(
        max(field.up_rad - UP, LOWER[1]), min(DOWN - field.down_rad, UPPER[1]), 30
    )
    covered.want_only([optical(yaw, pitch) for yaw in yaws for pitch in pitches], field)
    for view in views:
        assert LOWER[0] <= view[0] <= UPPER[0]
        assert LOWER[1] <= view[1] <= UPPER[1]
        covered.see(optical(*view), field)
    assert covered.share > 0.97


@pytest.mark.parametrize('field', FIELDS)
def test_with_turns_of_the_body_all_around_is_seen(field: FieldOfView) -> None:
    """The sweeps of all stances together leave no direction out."""
    coverage, heading = Coverage(UP, DOWN), 0.3
    views = head_sweep(field, LOWER, UPPER, UP, DOWN)
    for turn in (0.0, *stances(field, LOWER[0], UPPER[0])):
        heading += turn
        for yaw, pitch in views:
            coverage.see(optical(heading + yaw, pitch), field)
    assert coverage.share > 0.97


def test_rows_go_to_and_fro() -> None:
    """The head never swings back across the room for nothing."""
    views = head_sweep(FIELDS[1], LOWER, UPPER, UP, DOWN)
    rows = {pitch for _, pitch in views}
    assert len(rows) > 1
    for before, after in zip(views, views[1:]):
        assert (before[0] == after[0]) != (before[1] == after[1])


def test_a_wide_camera_needs_no_more_than_one_look() -> None:
    """If it sees all that is wanted."""
    wide = FieldOfView.of(100, 100, 10.0, 10.0, 50.0, 50.0)
    assert len(head_sweep(wide, (-0.0, -0.1), (0.0, 0.1), 0.2, 0.4)) == 1
    assert stances(wide, -3.0, 3.0) == []


def test_coverage_grows_from_nothing() -> None:
    """Each look adds; the same one again does not."""
    coverage, field = Coverage(UP, DOWN), FIELDS[0]
    assert coverage.share == 0.0
    shares = []
    for yaw in (0.0, 0.0, 1.0, -1.0):
        coverage.see(optical(yaw, 0.3), field)
        shares.append(coverage.share)
    assert 0.0 < shares[0] == shares[1] < shares[2] < shares[3] < 1.0


def test_a_look_up_does_not_count() -> None:
    """Nothing that is wanted is there."""
    coverage = Coverage(UP, DOWN)
    coverage.see(optical(0.0, -1.2), FIELDS[1])
    assert coverage.share == 0.0


@pytest.mark.parametrize(
    'bad', [(0, 240, 200.0), (320, 0, 200.0), (320, 240, 0.0), (320, 240, math.nan)]
)
def test_a_camera_without_a_picture_is_refused(bad) -> None:
    """Also one whose numbers are none."""
    with pytest.raises(ValueError, match='camera_info'):
        FieldOfView.of(bad[0], bad[1], bad[2], bad[2], 160.0, 120.0)
