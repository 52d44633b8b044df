# SPDX-License-Identifier: Apache-2.0
"""Test where a head turns to look at a point, with the model of the humanoid."""

from __future__ import annotations

import itertools
import math

from humanoid_description.expansion import humanoid_urdf
from humanoid_perception.gazing import HeadChain, HeadError
import numpy as np
import pytest

NAMES = ('head_yaw', 'head_pitch')
AHEAD = np.array([1.0, 0.0, 0.0])
CAMERA = np.eye(4)
CAMERA[:3, 3] = (0.08, 0.02, 0.06)


@pytest.fixture(scope='module')
def chain() -> HeadChain:
    """Return the head of the humanoid."""
    return HeadChain.of(humanoid_urdf(1.0, ''), NAMES)


def target_of(chain: HeadChain, angles, distance_m: float) -> np.ndarray:
    """Return the point at which the camera looks at some angles."""
    pose = chain.pose(angles) @ CAMERA
    return pose[:3, 3] + distance_m * pose[:3, 0]


def test_the_head_is_that_of_the_model(chain: HeadChain) -> None:
    """Its frames, limits, and the signs of REP 103: left is positive, and so is down."""
    assert (chain.tip_frame, len(chain.joints)) == ('head', 2)
    assert chain.lower_rad == pytest.approx([-1.4, -0.6])
    assert chain.upper_rad == pytest.approx([1.4, 0.9])
    left = chain.pose([1.0, 0.0])[:3, :3] @ AHEAD
    down = chain.pose([0.0, 0.5])[:3, :3] @ AHEAD
    assert left[1] > 0.5
    assert down[2] < -0.4


@pytest.mark.parametrize('seed', range(40))
def test_what_can_be_looked_at_is_looked_at(chain: HeadChain, seed: int) -> None:
    """From wherever the head is, near and far; the camera is beside the axes."""
    random = np.random.default_rng(seed)
    angles = random.uniform(chain.lower_rad, chain.upper_rad)
    target = target_of(chain, angles, random.uniform(0.4, 6.0))
    start = random.uniform(chain.lower_rad, chain.upper_rad)
    aim = chain.aim(target, CAMERA, AHEAD, start)
    assert aim.error_rad < 2e-3
    assert chain.error_rad(aim.angles_rad, target, CAMERA, AHEAD) == pytest.approx(aim.error_rad)
    assert (aim.angles_rad >= chain.lower_rad).all()
    assert (aim.angles_rad <= chain.upper_rad).all()


@pytest.mark.parametrize('seed', range(12))
def test_out_of_reach_it_looks_as_near_as_it_can(chain: HeadChain, seed: int) -> None:
    """No other angles within the limits come closer."""
    random = np.random.default_rng(seed)
    target = random.uniform(-3.0, 3.0, 3)
    aim = chain.aim(target, CAMERA, AHEAD, np.zeros(2))
    grids = (np.linspace(*each, 29) for each in zip(chain.lower_rad, chain.upper_rad))
    least = min(
        chain.error_rad(np.array(each), target, CAMERA, AHEAD)
        for each in itertools.product(*grids)
    )
    assert aim.error_rad <= least + 1e-3


@pytest.mark.parametrize('seed', range(10))
def test_angles_are_read_from_rotations(chain: HeadChain, seed: int) -> None:
    """Those of one joint after the other."""
    angles = np.random.default_rng(seed).uniform(chain.lower_rad, chain.upper_rad)
    first = HeadChain(chain.joints[:1]).pose(angles[:1])[:3, :3]
    second = HeadChain(chain.joints[1:]).pose(angles[1:])[:3, :3]
    assert chain.angle_of(0, first) == pytest.approx(angles[0])
    assert chain.angle_of(1, second) == pytest.approx(angles[1])


def test_another_axis_points_elsewhere(chain: HeadChain) -> None:
    """The optical axis of the camera is its z."""
    tip = CAMERA.copy()
    tip[:3, :3] = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
    target = np.array([2.0, 0.7, 0.3])
    z = np.array([0.0, 0.0, 3.0])
    aim = chain.aim(target, tip, z, np.zeros(2))
    same = chain.aim(target, CAMERA, AHEAD, np.zeros(2))
    assert aim.angles_rad == pytest.approx(same.angles_rad, abs=1e-3)


def test_a_target_in_the_camera_itself_does_no_harm(chain: HeadChain) -> None:
    """There is no way to it; the angles are finite."""
    pose = chain.pose([0.0, 0.0]) @ CAMERA
    aim = chain.aim(pose[:3, 3], CAMERA, AHEAD, np.zeros(2))
    assert np.isfinite(aim.angles_rad).all()
    assert math.isfinite(aim.error_rad)


@pytest.mark.parametrize(
    ('text', 'names', 'part'),
    [
        ('<robot', NAMES, 'cannot be read'),
        ('<robot name="r"/>', NAMES, 'no joint head_yaw'),
        (None, ('head_pitch', 'head_yaw'), 'from the body to the head'),
        (None, ('head_yaw', 'neck'), 'no joint neck'),
        (None, (), 'no joint'),
    ],
)
def test_a_model_without_such_a_head_is_named(text, names, part: str) -> None:
    """With a way out."""
    with pytest.raises(HeadError, match=part):
        HeadChain.of(text or humanoid_urdf(1.0, ''), names)
