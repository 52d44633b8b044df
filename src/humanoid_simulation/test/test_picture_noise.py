# SPDX-License-Identifier: Apache-2.0
"""Check how far the pixels of pictures are off."""

from __future__ import annotations

from dataclasses import replace

from humanoid_simulation.camera.images import PictureNoise, PictureNoiseSource
from humanoid_simulation.camera.protocol import Assignment
from humanoid_simulation.simulator_parameters import SimulatorParameters
from humanoid_simulation.testing.camera_studio import studio
import numpy as np
import pytest

NOISE = PictureNoise(color=3.0, depth_1_m=0.01, seed=5)


@pytest.mark.parametrize('distance_m', [1.0, 3.0])
def test_depth_is_off_by_the_square_of_the_distance(distance_m: float) -> None:
    """At 3 m nine times as much as at 1 m; where nothing is seen, nothing is still seen."""
    depth = np.full((200, 200), distance_m, np.float32)
    depth[0] = np.inf
    PictureNoiseSource(NOISE).spoil(None, depth)
    assert np.isinf(depth[0]).all()
    assert depth[1:].std() == pytest.approx(0.01 * distance_m**2, rel=0.05)
    assert depth[1:].mean() == pytest.approx(distance_m, abs=0.002)


def test_colors_are_off_and_stay_colors() -> None:
    """Grey has the deviation that is set; black and white do not turn into each other."""
    color = np.full((200, 200, 3), 128, np.uint8)
    color[0], color[1] = 0, 255
    PictureNoiseSource(NOISE).spoil(color, None)
    assert color[2:].std() == pytest.approx(3.0, rel=0.05)
    assert color[0].max() < 30 and color[1].min() > 225


def test_without_noise_pictures_stay_as_they_are() -> None:
    """No noise is none at all."""
    color, depth = np.full((4, 4, 3), 7, np.uint8), np.ones((4, 4), np.float32)
    PictureNoiseSource(PictureNoise()).spoil(color, depth)
    assert (color == 7).all() and (depth == 1.0).all()


def test_each_picture_has_noise_of_its_own_and_the_seed_decides() -> None:
    """Two pictures of one source differ, and another source with the seed gives the same two."""
    first, second, again = (np.full((8, 8, 3), 99, np.uint8) for _ in range(3))
    source = PictureNoiseSource(NOISE)
    source.spoil(first, None)
    source.spoil(second, None)
    PictureNoiseSource(NOISE).spoil(again, None)
    assert (first != second).any() and (first == again).all()


def test_the_process_that_draws_is_told() -> None:
    """The noise passes the command line."""
    assignment = Assignment('rays', 3, 4, (), NOISE)
    assert Assignment.from_text(assignment.as_text()) == assignment


def test_the_parameter_sensor_noise_is_for_cameras_too() -> None:
    """It multiplies the noise of pictures, and 0 is none."""
    assert SimulatorParameters().picture_noise == PictureNoise()
    noise = SimulatorParameters(sensor_noise=2.0, seed=4).picture_noise
    assert noise == PictureNoise(color=4.0, depth_1_m=0.004, seed=4)


def test_two_pictures_of_the_same_world_differ() -> None:
    """With noise, what the renderer delivers is not the same twice."""
    with studio(['rays'], noise=replace(NOISE, depth_1_m=0.05)) as place:
        one = place.picture()
        color, depth = one.colors[0].copy(), one.depths[0].copy()
        two = place.picture()
        assert (color != two.colors[0]).any() and (depth != two.depths[0]).any()
