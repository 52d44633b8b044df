# SPDX-License-Identifier: Apache-2.0
"""Check that the walk keeps the simulated robot on its feet, and takes it where it should."""

from __future__ import annotations

from collections.abc import Callable
import math

from humanoid_control.hosting.control_loop import ControlLoop
from humanoid_control.hosting.walking_robot import WalkingRobotControl
from humanoid_control.walking import PlanarPose, VelocityCommand, Walker, WalkParameters
from humanoid_description.loading import load_robot
from humanoid_simulation.backend import BackendSettings, MujocoBackend
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.model import humanoid
from humanoid_simulation.testing.lockstep_robot import DropOuts
import numpy as np
import pytest

MISSES_NONE: Callable[[], bool] = lambda: False  # noqa: E731


class Walk:
    """A robot that a walker moves, alone on a floor."""

    def __init__(
        self,
        backend: MujocoBackend,
        scale: float = 1.0,
        misses: Callable[[], bool] = MISSES_NONE,
    ) -> None:
        """Stand at home; the walker misses the ticks of which `misses` says so."""
        description = humanoid(scale)
        self.walker = Walker.of(
            load_robot(description.urdf, 'the humanoid'),
            description.drives,
            backend.joints,
            WalkParameters().scaled(scale),
        )
        self.backend = backend
        self.fallen_m = 0.7 * self.walker.home.base_height_m
        self._misses = misses

    @property
    def pose(self) -> PlanarPose:
        """Return where the robot truly is."""
        truth = self.backend.ground_truth()
        w, x, y, z = truth.orientation.tolist()
        yaw_rad = math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
        return PlanarPose(complex(*truth.position_m[:2]), yaw_rad)

    @property
    def phase(self) -> str:
        """Return what the gait does."""
        status = self.walker.status
        assert status is not None
        return status.phase

    def go(self, duration_s: float, *velocity: float) -> None:
        """Walk at a velocity (forward, left, turn) for some time, without falling."""
        self.walker.command(VelocityCommand(*velocity))
        for _ in range(round(duration_s / self.backend.period_s)):
            observation = self.backend.observe()['']
            self.backend.step({} if self._misses() else {'': self.walker.update(observation)})
            height_m = self.backend.ground_truth().position_m[2]
            assert height_m > self.fallen_m, f'fell at {self.backend.time_s:.2f} s'

    def push(self, direction: complex, impulse_ns: float) -> None:
        """Push the base for 0.1 s from the next period on."""
        force = direction * impulse_ns / 0.1
        self.backend.apply_wrench('base_link', (force.real, force.imag, 0.0), duration_s=0.1)


@pytest.fixture
def walk(backend: MujocoBackend) -> Walk:
    """Return a robot that stands."""
    robot = Walk(backend)
    robot.go(0.5)
    return robot


def test_it_stands(walk: Walk) -> None:
    """A robot that nobody moves stays where it is."""
    walk.go(10.0)
    assert abs(walk.pose.position_m) < 0.01
    assert walk.phase == 'stand'


def test_it_walks_straight(walk: Walk) -> None:
    """Three metres at 0.25 m/s, on a line, at the speed, and it stops within three seconds."""
    walk.go(2.0, 0.25)
    start = walk.pose
    walk.go(10.0, 0.25)
    way = start.local(walk.pose.position_m)
    assert way.real == pytest.approx(2.5, rel=0.08)
    assert abs(way.imag) < 0.1
    assert abs(walk.pose.yaw_rad) < 0.1
    walk.go(3.0)
    assert walk.phase == 'stand'
    stopped = walk.pose.position_m
    walk.go(1.0)
    assert abs(walk.pose.position_m - stopped) < 0.01


def test_it_walks_backwards(walk: Walk) -> None:
    """It goes back as far as it is told."""
    walk.go(6.0, -0.2)
    walk.go(3.0)
    assert walk.pose.position_m.real == pytest.approx(-1.1, abs=0.2)
    assert abs(walk.pose.position_m.imag) < 0.1


@pytest.mark.parametrize('left_m_s', [0.1, -0.1])
def test_it_steps_sideways(walk: Walk, left_m_s: float) -> None:
    """Half a metre to a side, without turning."""
    walk.go(5.0, 0.0, left_m_s)
    walk.go(3.0)
    assert walk.pose.position_m.imag == pytest.approx(5.0 * left_m_s, abs=0.12)
    assert abs(walk.pose.position_m.real) < 0.08
    assert abs(walk.pose.yaw_rad) < 0.1


def test_it_walks_fast(walk: Walk) -> None:
    """Half a metre a second, upright and at the speed, and it stops within three seconds."""
    walk.go(3.0, 0.5)
    start = walk.pose
    walk.go(6.0, 0.5)
    assert start.local(walk.pose.position_m).real == pytest.approx(3.0, rel=0.05)
    walk.go(3.0)
    assert walk.phase == 'stand'


def test_it_keeps_its_course_with_bad_sensors(make_backend: Callable[..., MujocoBackend]) -> None:
    """It strays by less than a twentieth of the way, and as little in speed and heading."""
    robot = Walk(make_backend(settings=BackendSettings(noise=REALISTIC, seed=5)))
    robot.go(2.5, 0.4)
    start, time_s = robot.pose, 10.12
    robot.go(time_s, 0.4)
    way = start.local(robot.pose.position_m)
    assert way.real == pytest.approx(0.4 * time_s, rel=0.05)
    assert abs(way.imag) < 0.05 * 0.4 * time_s
    assert abs(robot.pose.yaw_rad) < 0.05


def test_it_turns(walk: Walk) -> None:
    """On the spot, at the rate that it is told."""
    walk.go(1.5, 0.0, 0.0, 0.4)
    start, time_s = walk.pose, 4.16
    walk.go(time_s, 0.0, 0.0, 0.4)
    assert walk.pose.yaw_rad - start.yaw_rad == pytest.approx(0.4 * time_s, rel=0.12)
    assert abs(walk.pose.position_m - start.position_m) < 0.1


def test_odometry_knows_the_way(walk: Walk) -> None:
    """After a curve odometry is where the robot is, by a few hundredths of the way."""
    walk.go(8.0, 0.2, 0.03, 0.2)
    walk.go(3.0)
    status = walk.walker.status
    assert status is not None
    believed = status.odometry.pose
    assert abs(believed.position_m - walk.pose.position_m) < 0.08
    assert believed.yaw_rad == pytest.approx(walk.pose.yaw_rad, abs=0.02)
    assert status.odometry.height_m == pytest.approx(
        walk.backend.ground_truth().position_m[2], abs=0.01
    )


@pytest.mark.parametrize('direction', [1 + 0j, -1 + 0j, 1j, -1j])
def test_it_bears_a_push_while_standing(walk: Walk, direction: complex) -> None:
    """15 N s from any side: it steps, if it must, and stands again."""
    walk.push(direction, 15.0)
    walk.go(6.0)
    assert walk.phase == 'stand'


@pytest.mark.parametrize('direction', [1 + 0j, -1 + 0j, 1j, -1j])
def test_it_bears_a_push_while_walking(walk: Walk, direction: complex) -> None:
    """10 N s from any side: it walks on."""
    walk.go(2.2, 0.2)
    walk.push(direction, 10.0)
    walk.go(3.0, 0.2)
    assert walk.phase == 'walk'


def test_it_walks_with_bad_sensors_and_late(make_backend: Callable[..., MujocoBackend]) -> None:
    """Noise and a latency of 10 ms do not matter."""
    robot = Walk(
        make_backend(settings=BackendSettings(noise=REALISTIC, latency_periods=1, seed=3))
    )
    robot.go(0.5)
    robot.go(5.0, 0.25, 0.0, 0.2)
    robot.go(3.0)
    assert robot.phase == 'stand'


@pytest.mark.parametrize('seed', [pytest.param(0, marks=pytest.mark.story), 1])
def test_it_bears_missed_ticks(make_backend: Callable[..., MujocoBackend], seed: int) -> None:
    """Ticks that are missed for 10 to 100 ms, again and again, do not make it fall."""
    drop_outs = DropOuts(np.random.default_rng(seed), 0.02, 10)
    settings = BackendSettings(extrapolation_s=0.03)
    robot = Walk(make_backend(settings=settings), misses=drop_outs.misses)
    robot.go(0.5)
    robot.go(8.0, 0.3)
    robot.go(4.0)
    assert robot.phase == 'stand'


@pytest.mark.parametrize('steps_per_period', [2, 5])
def test_it_walks_at_other_rates(
    make_backend: Callable[..., MujocoBackend], steps_per_period: int
) -> None:
    """Control at 250 and at 100 Hz."""
    robot = Walk(make_backend(settings=BackendSettings(steps_per_period=steps_per_period)))
    robot.go(0.5)
    robot.go(4.0, 0.3)
    assert robot.pose.position_m.real > 0.7


@pytest.mark.parametrize('scale', [0.65, 1.3])
def test_robots_of_other_sizes_walk(scale: float, keyframes) -> None:
    """The same gait, scaled, moves smaller and larger robots."""
    robot = Walk(MujocoBackend(humanoid(scale), keyframes=keyframes), scale)
    robot.go(0.5)
    robot.go(5.0, 0.3 * math.sqrt(scale))
    robot.go(4.0)
    assert robot.pose.position_m.real > 0.9 * math.sqrt(scale)
    assert robot.phase == 'stand'


def test_the_same_walk_twice(make_backend: Callable[..., MujocoBackend]) -> None:
    """Two runs end in the same place, bit for bit."""
    ends = []
    for _ in range(2):
        robot = Walk(make_backend())
        robot.go(2.0, 0.2, 0.05, 0.1)
        ends.append(robot.pose)
    assert ends[0] == ends[1]


@pytest.mark.parametrize('keyframe', ['stretched', 'crouched'])
def test_it_begins_in_other_postures(backend: MujocoBackend, keyframe: str) -> None:
    """From stretched legs or a crouch the robot comes to stand as it does at home."""
    description = humanoid()
    robot = WalkingRobotControl.of(
        load_robot(description.urdf, 'the humanoid'), description.drives
    )
    loop = ControlLoop(backend, {'': robot.control})
    loop.reset(keyframe)
    for _ in range(400):
        loop.tick()
    status = robot.walker.status
    assert status is not None
    assert status.phase == 'stand'
    height_m = backend.ground_truth().position_m[2]
    assert height_m == pytest.approx(robot.walker.home.base_height_m, abs=0.01)
