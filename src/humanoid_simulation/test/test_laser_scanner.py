# SPDX-License-Identifier: Apache-2.0
"""Check what a laser scanner measures, against what geometry says."""

from __future__ import annotations

import math

from humanoid_description.rotations import from_quaternion, quaternion_from_rpy
from humanoid_simulation.backend import BackendSettings, EntityState, MujocoBackend
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.laser_scanner import LaserScanner, ScanNoise, ScanPattern
from humanoid_simulation.model import Placement
from humanoid_simulation.scene import load_scene, Scene, Thing
from humanoid_simulation.testing.lockstep_robot import LockstepRobot
import mujoco
import numpy as np
import pytest

LINK = 'robot/laser'
# The inner faces of the walls.
FRONT_M, BACK_M, LEFT_M, RIGHT_M = 4.0, -3.0, 2.5, -2.0
LASER_ABOVE_BASE_M = 0.09


def wall(name: str, size: tuple[float, float, float], x: float, y: float) -> Thing:
    """Return a wall on the floor, by its size and its middle."""
    return Thing(name, 'box', size, (x, y, size[2] / 2))


def room() -> Scene:
    """Return a room with four walls of 3 m."""
    return Scene(
        'room',
        things=(
            wall('front', (0.2, 10.0, 3.0), FRONT_M + 0.1, 0.0),
            wall('back', (0.2, 10.0, 3.0), BACK_M - 0.1, 0.0),
            wall('left', (10.0, 0.2, 3.0), 0.0, LEFT_M + 0.1),
            wall('right', (10.0, 0.2, 3.0), 0.0, RIGHT_M - 0.1),
        ),
    )


def distances_m(position_m: np.ndarray, rays: np.ndarray) -> np.ndarray:
    """Compute how far rays (n, 3) get in the room: to the nearest plane that is ahead."""
    with np.errstate(divide='ignore', invalid='ignore'):
        ways_m = [
            np.where(side * rays[:, axis] > 0.0, (at_m - position_m[axis]) / rays[:, axis], np.inf)
            for axis, side, at_m in (
                (0, 1, FRONT_M),
                (0, -1, BACK_M),
                (1, 1, LEFT_M),
                (1, -1, RIGHT_M),
                (2, -1, 0.0),
            )
        ]
    return np.min(ways_m, axis=0)


def standing(x: float = 0.5, y: float = -0.3, yaw_rad: float = 0.3) -> MujocoBackend:
    """Return a robot that has just been put somewhere in the room."""
    return MujocoBackend(scene=room(), placements=[Placement('', x, y, yaw_rad=yaw_rad)])


def expected_m(backend: MujocoBackend, pattern: ScanPattern = ScanPattern()) -> np.ndarray:
    """Compute what the scanner of a robot with a straight waist should measure."""
    base = backend.ground_truth()
    turn = from_quaternion(base.orientation)
    angles = -math.pi + np.arange(pattern.rays) * 2.0 * math.pi / pattern.rays
    rays = np.stack([np.cos(angles), np.sin(angles), np.zeros(pattern.rays)], axis=1)
    position_m = base.position_m + turn @ (0.0, 0.0, LASER_ABOVE_BASE_M)
    return distances_m(position_m, rays @ turn.T)


def test_ranges_are_those_of_the_room() -> None:
    """Each ray measures the distance to the wall that it meets, anticlockwise from the back."""
    backend = standing()
    scan = LaserScanner(backend.model, LINK).sweep(backend.data, 0)
    assert scan.shape == (360,)
    assert scan == pytest.approx(expected_m(backend), abs=1e-5)
    assert scan[180] == pytest.approx((FRONT_M - 0.5) / math.cos(0.3), abs=1e-5)


def test_a_scanner_that_leans() -> None:
    """A robot that leans forwards measures the floor ahead, and the wall behind it higher up."""
    backend = standing(0.0, 0.0, 0.0)
    state = EntityState(
        np.array([0.0, 0.0, 1.0]), quaternion_from_rpy(0.0, 0.5, 0.0), np.zeros(3), np.zeros(3)
    )
    backend.set_entity_state('', state)
    scan = LaserScanner(backend.model, LINK).sweep(backend.data, 0)
    assert scan == pytest.approx(expected_m(backend), abs=1e-5)
    assert scan[180] < 2.5 < scan[0]


def test_noise_has_the_deviation_that_is_set() -> None:
    """Errors have no bias, the deviation that is set, and some rays bring nothing back."""
    backend = standing()
    noise = ScanNoise(range_m=0.02, dropout_share=0.05, seed=5)
    scanner = LaserScanner(backend.model, LINK, noise=noise)
    scans = np.array([scanner.sweep(backend.data, time_ns) for time_ns in range(200)])
    lost = np.isnan(scans)
    assert lost.mean() == pytest.approx(0.05, rel=0.1)
    errors_m = (scans - expected_m(backend))[~lost]
    assert errors_m.std() == pytest.approx(0.02, rel=0.03)
    assert abs(errors_m.mean()) < 3e-4


def test_noise_is_that_of_seed_robot_and_time() -> None:
    """The same seed gives the same noise at the same time; each robot has its own."""
    backend = standing()

    def scan(seed: int, number: int, time_ns: int) -> list[float]:
        noise = ScanNoise(range_m=0.02, seed=seed)
        scanner = LaserScanner(backend.model, LINK, noise=noise, number=number)
        return list(scanner.sweep(backend.data, time_ns).tolist())

    assert scan(1, 0, 7) == scan(1, 0, 7)
    assert len({tuple(scan(*key)) for key in [(1, 0, 7), (2, 0, 7), (1, 1, 7), (1, 0, 8)]}) == 4


def test_too_near_and_too_far() -> None:
    """What is out of range has no number: plus infinity is too far, minus infinity too near."""
    backend = standing()
    pattern = ScanPattern(range_min_m=2.0, range_max_m=3.0)
    scan = LaserScanner(backend.model, LINK, pattern).sweep(backend.data, 0)
    true_m = expected_m(backend)
    assert np.array_equal(np.isneginf(scan), true_m < 2.0)
    assert np.array_equal(np.isposinf(scan), true_m > 3.0)
    assert np.isneginf(scan).any() and np.isposinf(scan).any() and np.isfinite(scan).any()


def test_other_robots_are_seen() -> None:
    """A robot measures the distance to another one, but not to itself."""
    places = [Placement('one', 0.0, 0.0), Placement('two', 1.5, 0.0, z_m=0.1)]
    backend = MujocoBackend(scene=room(), placements=places)
    scans = {
        name: LaserScanner(backend.model, f'{name}/laser').sweep(backend.data, 0)
        for name in ('one', 'two')
    }
    assert 1.3 < scans['one'][180] < 1.5 and scans['one'][0] == pytest.approx(3.0, abs=1e-5)
    assert 1.3 < scans['two'][0] < 1.5 and scans['two'][180] == pytest.approx(2.5, abs=1e-5)


def test_each_ray_is_as_if_cast_alone() -> None:
    """In the apartment, full of things of many geoms, a sweep misses nothing that a ray meets."""
    backend = MujocoBackend(scene=load_scene('apartment'))
    model, data = backend.model, backend.data
    scanner = LaserScanner(model, LINK)
    link = model.body(LINK).id
    own = model.body_rootid[model.geom_bodyid] == model.body_rootid[link]
    rays = scanner.pattern.directions() @ data.xmat[link].reshape(3, 3).T
    scan = scanner.sweep(data, 0)
    model.geom_group[own] = 5
    shown, geom = np.array([1, 1, 1, 0, 0, 0], dtype=np.uint8), np.empty(1, dtype=np.int32)
    alone_m = np.array(
        [mujoco.mj_ray(model, data, data.xpos[link], ray, shown, True, -1, geom) for ray in rays]
    )
    assert scan == pytest.approx(alone_m, abs=1e-4)


def test_the_world_is_left_as_it_was() -> None:
    """Nothing is hidden any more after a sweep, and it may be repeated."""
    backend = standing()
    groups = backend.model.geom_group.copy()
    scanner = LaserScanner(backend.model, LINK)
    first = scanner.sweep(backend.data, 0)
    assert np.array_equal(scanner.sweep(backend.data, 0), first)
    assert np.array_equal(backend.model.geom_group, groups)


def test_no_ray_meets_the_own_body() -> None:
    """While the robot walks, turns and swings its arms, it measures the room and no arm of it."""
    robot = LockstepRobot(BackendSettings(), room())
    scanner = LaserScanner(robot.backend.model, LINK)
    arms = [f'{side}_{joint}' for side in ('left', 'right') for joint in ('shoulder', 'elbow')]
    robot.drive(forward=0.2, turn=0.3)
    link = robot.backend.model.body(LINK).id
    for tick in range(600):
        swing_rad = 0.9 * math.sin(0.06 * tick)
        wanted_rad = [swing_rad, -0.8 + 0.5 * swing_rad, -swing_rad, -0.8 - 0.5 * swing_rad]
        robot.walking.control.follow(arms, wanted_rad)
        robot.tick()
        if tick % 10 == 0:
            data = robot.backend.data
            turn = data.xmat[link].reshape(3, 3)
            rays = scanner.pattern.directions() @ turn.T
            scan = scanner.sweep(data, tick)
            assert scan == pytest.approx(distances_m(data.xpos[link], rays), abs=1e-4)
    assert robot.stands and abs(robot.pose.position_m) > 0.5


def test_a_scanner_on_no_link() -> None:
    """A link that the world has not is refused, with the names that it has."""
    with pytest.raises(SimulationError, match="no link 'robot/lasr'. Did you mean 'robot/laser'"):
        LaserScanner(standing().model, 'robot/lasr')
