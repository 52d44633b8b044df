# SPDX-License-Identifier: Apache-2.0
"""Check properties that all plans of footsteps have, and that they come back to the path."""

from __future__ import annotations

from itertools import islice, pairwise
import math

from humanoid_control.walking.commands import STANDING, VelocityCommand, VelocityLimits
from humanoid_control.walking.footsteps import Footstep, FootstepPlanner, ReferencePath
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import LEFT, other, outwards, PlanarPose, RIGHT
import numpy as np
import pytest

P = WalkParameters()
PLANNER = FootstepPlanner(P)
RANDOM = np.random.default_rng(2)
COMMANDS = [
    VelocityLimits.of(P.velocity).applied(
        VelocityCommand(*(RANDOM.uniform(-1, 1, 3) * (0.5, 0.3, 1.5)).tolist())
    )
    for _ in range(60)
]
FORWARD = VelocityCommand(0.3)


def steps(command: VelocityCommand, count: int, support: int = LEFT) -> list[Footstep]:
    """Return a plan that begins on one foot, that foot first."""
    first = PLANNER.next_foot(PlanarPose(0.1 + 0.2j, 0.7), support, command)
    return list(islice(PLANNER.footsteps(first, support, command), count))


@pytest.mark.parametrize('command', COMMANDS)
def test_feet_never_cross(command: VelocityCommand) -> None:
    """The left foot lands left of the right one, and as far from it as feet need."""
    for before, after in pairwise(steps(command, 12)):
        place = before.pose.local(after.pose.position_m)
        assert after.side == other(before.side)
        assert outwards(after.side) * place.imag > P.footsteps.least_width_m - 1e-9


@pytest.mark.parametrize('command', COMMANDS)
def test_steps_are_within_reach(command: VelocityCommand) -> None:
    """No planned step is longer or wider than one that may catch the robot."""
    for before, after in pairwise(steps(command, 12)):
        place = before.pose.local(after.pose.position_m)
        assert abs(place.real) < P.footsteps.most_length_m
        assert abs(place.imag) < P.footsteps.most_width_m


@pytest.mark.parametrize('support', [LEFT, RIGHT])
@pytest.mark.parametrize('command', COMMANDS[:20])
def test_two_steps_go_the_commanded_way(command: VelocityCommand, support: int) -> None:
    """In two steps the robot turns and moves as it does at the velocity in their time."""
    start, _, end = steps(command, 3, support)
    time_s = 2 * P.timing.step_s
    turn_rad = command.turn_rad_s * time_s
    assert end.pose.yaw_rad - start.pose.yaw_rad == pytest.approx(turn_rad)
    if not command.turn_rad_s:
        way = start.pose.local(end.pose.position_m)
        assert way == pytest.approx(command.linear_m_s * time_s)


@pytest.mark.parametrize('linear', [0.3, -0.2, 0.1j, -0.12j, 0.2 + 0.05j])
def test_velocity_without_turn(linear: complex) -> None:
    """Feet that go straight have the commanded velocity, forward and sideways."""
    command = VelocityCommand(linear.real, linear.imag)
    start, *_, end = steps(command, 11)
    way = start.pose.local(end.pose.position_m)
    assert way == pytest.approx(linear * 10 * P.timing.step_s)


@pytest.mark.parametrize('command', COMMANDS)
def test_plan_ends_parallel(command: VelocityCommand) -> None:
    """Two steps after the velocity has become zero the feet stand side by side."""
    last = steps(command, 8)[-1]
    stop = PLANNER.next_foot(last.pose, last.side, STANDING)
    assert PLANNER.is_parallel(last.pose, last.side, stop)
    assert stop.yaw_rad == last.pose.yaw_rad
    assert abs(last.pose.local(stop.position_m)) == pytest.approx(P.footsteps.width_m)


def test_turning_on_the_spot_stays() -> None:
    """A full turn ends where it began."""
    turns = math.ceil(2 * math.pi / (0.5 * 2 * P.timing.step_s))
    command = VelocityCommand(turn_rad_s=2 * math.pi / turns / (2 * P.timing.step_s))
    start, *_, end = steps(command, 2 * turns + 1)
    assert end.pose.position_m == pytest.approx(start.pose.position_m, abs=1e-9)


@pytest.mark.parametrize('place', [0.04 + 0.18j, 0.18j + 0.04j, -0.18j])
def test_feet_that_are_not_parallel(place: complex) -> None:
    """Feet that are ahead of each other, too wide, or crossed are no place to stop."""
    assert PLANNER.is_parallel(PlanarPose(), RIGHT, PlanarPose(0.18j))
    assert not PLANNER.is_parallel(PlanarPose(), RIGHT, PlanarPose(place))
    assert not PLANNER.is_parallel(PlanarPose(), RIGHT, PlanarPose(0.18j, 0.1))


def walked(steps: int, stray: complex, stray_rad: float, slow: float = 1.0) -> PlanarPose:
    """Return where steps forward lead that each land a little off, and take longer by a factor."""
    path, middle, side = ReferencePath(PLANNER), PlanarPose(), LEFT
    for _ in range(steps):
        goal = PLANNER.next_middle(path.corrected(middle), side, FORWARD)
        middle = PlanarPose(goal.position_m + stray, goal.yaw_rad + stray_rad)
        path.advance(side, FORWARD, slow * P.timing.step_s)
        side = other(side)
    return middle


def test_perfect_steps_need_no_correction() -> None:
    """A robot that lands where planned is on its path."""
    end = walked(20, 0j, 0.0)
    assert end.position_m == pytest.approx(20 * P.timing.step_s * 0.3)
    assert end.yaw_rad == 0.0


def test_straying_does_not_add_up() -> None:
    """Forty steps of which each strays stay as near to the line as a few."""
    end = walked(40, 0.002 - 0.004j, 0.01)
    assert abs(end.position_m - 40 * P.timing.step_s * 0.3) < 0.03
    assert abs(end.yaw_rad) < 0.03


def test_slow_steps_go_farther() -> None:
    """A step that takes longer than planned goes as far as the velocity asks in that time."""
    far_m = walked(40, 0j, 0.0, slow=1.03).position_m.real
    assert far_m == pytest.approx(40 * 1.03 * P.timing.step_s * 0.3, rel=0.01)


def test_a_push_is_not_made_up_for() -> None:
    """What moves the robot far off moves its path too, up to a little."""
    path = ReferencePath(PLANNER)
    path.corrected(PlanarPose())
    pushed = PlanarPose(0.3 + 0.4j, 1.0)
    start = path.corrected(pushed)
    back_m = P.footsteps.path_gain * P.footsteps.path_distance_m
    assert abs(start.position_m - pushed.position_m) == pytest.approx(back_m)
    assert pushed.yaw_rad - start.yaw_rad == pytest.approx(
        P.footsteps.path_gain * P.footsteps.path_turn_rad
    )
    again = path.corrected(pushed)
    assert again.position_m == pytest.approx(start.position_m)


def test_a_restart_forgets_the_way() -> None:
    """A robot that begins to walk is where it is."""
    path, here = ReferencePath(PLANNER), PlanarPose(1 + 2j, 0.5)
    path.corrected(PlanarPose())
    path.restart()
    path.advance(LEFT, FORWARD, P.timing.step_s)
    assert path.corrected(here) == here
    path.advance(LEFT, STANDING, P.timing.step_s)
    assert path.corrected(here).position_m == pytest.approx(here.position_m)
