# SPDX-License-Identifier: Apache-2.0
"""Check the gait on an ideal robot: a pendulum with feet that go where they are told."""

from __future__ import annotations

from collections.abc import Callable

from humanoid_control.walking.commands import STANDING, VelocityCommand
from humanoid_control.walking.footing import Foothold, Footing, SoleReading
from humanoid_control.walking.gait import Gait
from humanoid_control.walking.gait_context import GaitContext, GaitInput, GaitOutput
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.pendulum import Motion, Pendulum
from humanoid_control.walking.planar import (
    GroundPlane,
    LEFT,
    LEVEL,
    other,
    outwards,
    PlanarPose,
    SIDES,
)
from humanoid_control.walking.support_polygon import FootShape
from humanoid_control.walking.swing_foot import SoleMotion
import numpy as np
import pytest

P = WalkParameters()
SHAPE = FootShape(0.115, -0.065, 0.043, -0.043, 0.015 - 0.005j)
FORWARD = VelocityCommand(0.3)


class IdealRobot:
    """A pendulum of constant height on the feet of a gait."""

    def __init__(self, tick_s: Callable[[], float] = lambda: 0.01, yaw_rad: float = 0.0) -> None:
        """Stand still; ticks come as `tick_s` says."""
        body = PlanarPose(0j, yaw_rad)
        feet = [PlanarPose(body.at(0.0, 0.09 * outwards(side)), yaw_rad) for side in SIDES]
        self.pendulum = Pendulum(0.7)
        self.footing = Footing(SHAPE, [Foothold(pose) for pose in feet])
        self.gait = Gait(GaitContext(P, self.pendulum, self.footing))
        self.motion = Motion(self.footing.rest_point)
        self.velocity = STANDING
        self.output: GaitOutput | None = None
        self.errors_m: list[float] = []
        self.phases: list[str] = []
        self._tick_s = tick_s

    def run(self, time_s: float) -> None:
        """Let time pass."""
        while time_s > 0.0:
            passed_s = self._tick_s()
            zmp = self.output.zmp_m if self.output else self.footing.rest_point
            self.motion = self.pendulum.after(self.motion, zmp, passed_s)
            dcm = self.pendulum.dcm(self.motion)
            left, right = map(self._sole, SIDES)
            now = GaitInput(passed_s, dcm, zmp, (left, right), self.velocity)
            self.output = self.gait.update(now)
            self.errors_m.append(abs(dcm - self.output.reference.dcm_m))
            self.phases.append(self.gait.phase)
            time_s -= passed_s

    def go(self, command: VelocityCommand, time_s: float) -> PlanarPose:
        """Go at a velocity for some time; return how far that was, from middle to middle."""
        start = self.footing.middle
        self.velocity = command
        self.run(time_s)
        end = self.footing.middle
        return PlanarPose(start.local(end.position_m), end.yaw_rad - start.yaw_rad)

    @property
    def sole(self) -> SoleMotion | None:
        """Return where the foot in the air is to be, if one is."""
        swing = self.output.swing if self.output else None
        return swing.sole if swing else None

    def push(self, speed_m_s: complex) -> None:
        """Change the velocity at once."""
        speed = self.motion.velocity_m_s + speed_m_s
        self.motion = Motion(self.motion.position_m, speed)

    @property
    def is_upright(self) -> bool:
        """Tell whether the weight is still near the feet."""
        return abs(self.motion.position_m - self.footing.middle.position_m) < 0.3

    def _sole(self, side: int) -> SoleReading:
        """Return a sole that is where it was told to be at the tick before."""
        swing = self.output.swing if self.output else None
        if swing and swing.side == side:
            plane = GroundPlane(max(0.0, swing.sole.plane.height_m))
            return SoleReading(swing.sole.pose, plane, 0.0 if plane.height_m else 0.5)
        return SoleReading(self.footing.pose(side), LEVEL, 0.5)


def test_standing_stands() -> None:
    """Without a velocity nothing moves."""
    robot = IdealRobot()
    robot.run(5.0)
    assert set(robot.phases) == {'stand'}
    assert max(robot.errors_m) < 1e-12


@pytest.mark.parametrize(
    'command',
    [
        VelocityCommand(0.3),
        VelocityCommand(-0.2),
        VelocityCommand(0.0, 0.1),
        VelocityCommand(0.0, -0.1),
        VelocityCommand(0.0, 0.0, 0.5),
        VelocityCommand(0.2, 0.03, -0.2),
    ],
)
def test_walk_and_stop(command: VelocityCommand) -> None:
    """The robot reaches the velocity, keeps balance and stands at the end."""
    robot = IdealRobot()
    robot.go(command, 4.0)
    time_s = 8 * P.timing.step_s
    way = robot.go(command, time_s)
    assert way.yaw_rad == pytest.approx(command.turn_rad_s * time_s, rel=0.2, abs=0.02)
    straight_m = abs(command.linear_m_s) * time_s
    assert abs(way.position_m) == pytest.approx(straight_m, rel=0.2, abs=0.04)
    assert max(robot.errors_m) < 0.04
    robot.go(STANDING, 5.0)
    assert robot.phases[-1] == 'stand'
    feet = [robot.footing.pose(side) for side in SIDES]
    assert robot.gait.footsteps == ()
    assert abs(feet[LEFT].local(feet[other(LEFT)].position_m).imag) == pytest.approx(
        0.18, abs=0.01
    )


def test_phases_follow_each_other() -> None:
    """Standing becomes walking, walking comes to rest, rest becomes standing."""
    robot = IdealRobot()
    robot.run(0.5)
    robot.go(FORWARD, 3.0)
    robot.go(STANDING, 5.0)
    changes = [b for a, b in zip(robot.phases, robot.phases[1:]) if a != b]
    assert changes == ['walk', 'stop', 'stand']


def test_walking_on_while_stopping() -> None:
    """A velocity that comes while the robot comes to rest makes it walk on."""
    robot = IdealRobot()
    robot.go(FORWARD, 3.0)
    robot.velocity = STANDING
    while robot.gait.phase == 'walk':
        robot.run(0.01)
    assert robot.gait.phase == 'stop'
    way = robot.go(FORWARD, 3.0)
    assert robot.gait.phase == 'walk'
    assert way.position_m.real > 0.4


def test_first_foot_is_on_the_side_of_the_way() -> None:
    """To the left the left foot goes first, in a left turn as well, else it is the left leg."""
    for command, side in (
        (VelocityCommand(left_m_s=0.1), LEFT),
        (VelocityCommand(left_m_s=-0.1), other(LEFT)),
        (VelocityCommand(turn_rad_s=0.3), LEFT),
        (VelocityCommand(turn_rad_s=-0.3), other(LEFT)),
    ):
        robot = IdealRobot()
        robot.go(command, 0.1)
        assert robot.gait.footsteps[0].side == side


@pytest.mark.parametrize('rate_hz', [50, 100, 200])
def test_rates(rate_hz: int) -> None:
    """The gait is the same at any rate of ticks."""
    robot = IdealRobot(lambda: 1.0 / rate_hz)
    way = robot.go(FORWARD, 8.0)
    assert way.position_m.real == pytest.approx(2.0, abs=0.25)
    assert robot.is_upright


def test_gaps() -> None:
    """Ticks that come after 5 to 100 ms at random do not make an ideal robot fall."""
    random = np.random.default_rng(6)

    def tick_s() -> float:
        return float(random.uniform(0.005, 0.1)) if random.random() < 0.1 else 0.01

    robot = IdealRobot(tick_s)
    robot.go(FORWARD, 10.0)
    assert robot.is_upright
    robot.go(STANDING, 6.0)
    assert robot.phases[-1] == 'stand'


@pytest.mark.parametrize('in_air_s', [0.02, 0.1, 0.15])
def test_a_gap_makes_no_foot_jump(in_air_s: float) -> None:
    """After 190 ms without control the foot in the air goes on from where it is."""
    ticks_s = [0.01]
    robot = IdealRobot(lambda: ticks_s.pop() if len(ticks_s) > 1 else ticks_s[0])
    robot.go(FORWARD, 3.0)
    while robot.sole:
        robot.run(0.01)
    while not robot.sole:
        robot.run(0.01)
    robot.run(in_air_s)
    before = robot.sole
    ticks_s.append(0.19)
    robot.run(0.01)
    after = robot.sole
    assert before and after
    assert abs(after.pose.position_m - before.pose.position_m) < 0.06
    assert abs(after.plane.height_m - before.plane.height_m) < 0.03


@pytest.mark.parametrize('push_m_s', [0.35, -0.35, 0.35j, -0.35j])
@pytest.mark.parametrize('yaw_rad', [0.0, 2.0])
def test_a_push_while_standing(push_m_s: complex, yaw_rad: float) -> None:
    """A robot that is pushed at 15 N s steps, and stands again."""
    robot = IdealRobot(yaw_rad=yaw_rad)
    robot.run(1.0)
    robot.push(push_m_s * np.exp(1j * yaw_rad))
    robot.run(6.0)
    assert 'walk' in robot.phases
    assert robot.phases[-1] == 'stand'
    assert robot.is_upright


@pytest.mark.parametrize('push_m_s', [0.25, -0.25, 0.25j, -0.25j])
@pytest.mark.parametrize('phase_s', [0.0, 0.13, 0.26, 0.39])
def test_a_push_while_walking(push_m_s: complex, phase_s: float) -> None:
    """A push of 10 N s in any part of a step does not make it fall."""
    robot = IdealRobot()
    robot.go(VelocityCommand(0.2), 3.0 + phase_s)
    robot.push(push_m_s)
    robot.run(4.0)
    assert robot.is_upright
    assert robot.errors_m[-1] < 0.05
