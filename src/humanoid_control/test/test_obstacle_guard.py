# SPDX-License-Identifier: Apache-2.0
"""Check what the walk does about things in its way."""

from __future__ import annotations

import cmath
import math

from humanoid_control.walking.commands import STANDING, VelocityCommand
from humanoid_control.walking.obstacle_guard import ExternalForces, LegInAir, ObstacleGuard
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import LEFT, PlanarPose, Point, RIGHT
from humanoid_control.walking.touch import ForceObserver
import numpy as np
import pytest

P = WalkParameters()
TICK_S = 0.01
AHEAD = VelocityCommand(0.3)
LEANING = 0.05 + 0j
"""A divergent component that is off ahead; so the robot does not go back yet."""


class Walk:
    """A robot that faces the x axis, and the guard that watches it."""

    def __init__(self) -> None:
        """Begin somewhere."""
        self.guard = ObstacleGuard(P)
        self.body = PlanarPose(1.0 + 2.0j, 0.0)

    def feel(
        self,
        force_n: Point,
        time_s: float,
        wanted: VelocityCommand = AHEAD,
        error_m: Point = 0j,
    ) -> VelocityCommand:
        """Let a force act for some time; return the velocity that is allowed then."""
        for _ in range(round(time_s / TICK_S)):
            self.meet(ExternalForces(force_n), wanted, error_m)
            moved_m = TICK_S * self.guard.allowed(wanted, self.body.yaw_rad).linear_m_s
            self.body = self.body.moved(moved_m)
        return self.guard.allowed(wanted, self.body.yaw_rad)

    def meet(
        self, contact: ExternalForces, wanted: VelocityCommand = AHEAD, error_m: Point = 0j
    ) -> bool:
        """Feel something at a tick; return whether it is taken for something new in the way."""
        allowed, stands = self.guard.allowed(wanted, self.body.yaw_rad), (self.body, self.body)
        going = allowed if allowed.linear_m_s else wanted
        return self.guard.update(contact, stands, wanted, going, error_m, TICK_S)


def test_a_push_is_no_obstacle() -> None:
    """8 N s within a tenth of a second, then nothing: it walks on."""
    walk = Walk()
    assert walk.feel(-80.0 + 0j, 0.1) == AHEAD
    assert walk.feel(0j, 1.0) == AHEAD
    assert walk.guard.blockage is None


def test_what_helps_is_no_obstacle() -> None:
    """A force along the way, or on a robot that stands, stops nothing."""
    walk = Walk()
    assert walk.feel(80.0 + 0j, 1.0) == AHEAD
    assert Walk().feel(-80.0 + 0j, 1.0, STANDING) == STANDING


def test_it_steps_back_and_goes_no_further() -> None:
    """A wall ahead: it retreats by what is set, then stands for as long as somebody insists."""
    walk = Walk()
    back = walk.feel(-60.0 + 0j, 0.5)
    assert back.forward_m_s == pytest.approx(-P.obstacles.retreat_m_s)
    assert back.left_m_s == pytest.approx(0.0, abs=1e-9)
    assert walk.guard.blockage is not None
    met_m = walk.guard.blockage.place_m
    assert walk.feel(0j, 5.0).is_zero
    assert P.obstacles.retreat_m / 2 <= (met_m - walk.body.position_m).real < P.obstacles.retreat_m
    assert walk.feel(0j, 10.0).is_zero


def test_a_robot_that_tips_towards_the_obstacle_catches_itself_first() -> None:
    """While its balance is off that way it does not step away from under its weight."""
    walk = Walk()
    assert walk.feel(-60.0 + 0j, 0.5, AHEAD, LEANING).is_zero
    assert walk.feel(0j, 0.1, AHEAD, -0.05 + 0j).forward_m_s < 0.0


@pytest.mark.parametrize('wanted', [VelocityCommand(-0.2), VelocityCommand(0.0, 0.1)])
def test_another_way_is_free(wanted: VelocityCommand) -> None:
    """Away from the wall, or along it, it goes as it is told."""
    walk = Walk()
    walk.feel(-60.0 + 0j, 0.5)
    walk.feel(0j, 3.0)
    assert walk.feel(0j, 0.1, wanted) == wanted


def test_it_slides_along_what_it_meets_at_an_angle() -> None:
    """Of a velocity that leads mostly past the wall, the part along it is left."""
    walk = Walk()
    walk.feel(-60.0 + 0j, 0.5)
    walk.feel(0j, 3.0)
    allowed = walk.feel(0j, 0.01, VelocityCommand(0.1, 0.15))
    assert (allowed.forward_m_s, allowed.left_m_s) == pytest.approx((0.0, 0.15), abs=1e-9)


def test_who_lets_go_may_try_again() -> None:
    """After a while without the command the way counts as free."""
    walk = Walk()
    walk.feel(-60.0 + 0j, 0.5)
    walk.feel(0j, 3.0)
    walk.feel(0j, P.obstacles.let_go_s + 0.1, STANDING)
    assert walk.feel(0j, 0.1) == AHEAD


def leg(push_nm: Point, side: int = LEFT) -> ExternalForces:
    """Return what is felt with a leg in the air whose foot is a little ahead."""
    return ExternalForces(leg=LegInAir(side, push_nm, 1.1 + 2.1j))


def test_a_leg_that_is_stopped_is_enough() -> None:
    """It tells of an obstacle before that has stopped the robot."""
    walk = Walk()
    assert walk.meet(leg(-1.1 * P.obstacles.leg_touch_nm + 0j))
    assert walk.feel(0j, 0.1).forward_m_s < 0.0


@pytest.mark.parametrize('push_nm', [-0.5 + 0j, 3.0 + 0j, 3.0j])
def test_a_leg_that_is_pushed_elsewhere_is_not_stopped(push_nm: Point) -> None:
    """Forward, aside, or hardly at all: nothing is in the way of the robot."""
    walk = Walk()
    assert not walk.meet(leg(push_nm * P.obstacles.leg_touch_nm))
    assert walk.guard.blockage is None


def test_less_stops_a_step_to_the_side() -> None:
    """Legs swing less to the side, and so their touch is known better."""
    push_nm = -1.1 * P.obstacles.leg_touch_aside_nm
    assert not Walk().meet(leg(push_nm + 0j))
    assert Walk().meet(leg(1j * push_nm), VelocityCommand(0.0, 0.15))


def test_a_leg_is_stopped_once() -> None:
    """What the same leg feels on its way back changes nothing; the other leg is another one."""
    walk, push_nm = Walk(), -2.0 * P.obstacles.leg_touch_nm + 0j
    assert walk.meet(leg(push_nm), AHEAD, LEANING)
    assert not walk.meet(leg(push_nm), AHEAD, LEANING)
    assert walk.meet(leg(push_nm, RIGHT), AHEAD, LEANING)


def test_an_arm_feels_a_thing_in_the_way() -> None:
    """One that is pushed back is enough; one that is pushed forward or hardly is not."""
    arm_nm = 1.1 * P.obstacles.arm_touch_nm
    for contact in (
        ExternalForces(arms_nm=(0j, arm_nm + 0j)),
        ExternalForces(arms_nm=(-0.5 * arm_nm + 0j,)),
    ):
        assert not Walk().meet(contact)
    walk, touch = Walk(), ExternalForces(arms_nm=(0j, -arm_nm + 0j))
    assert walk.meet(touch, AHEAD, LEANING)
    assert not walk.meet(touch, AHEAD, LEANING), 'it is known'
    assert not Walk().meet(touch, STANDING)


def test_friction_does_not_lead_it_astray() -> None:
    """What pushes aside as much as back is still rather ahead: there the robot went."""
    walk = Walk()
    walk.meet(leg((-1.0 + 1.0j) * 2.0 * P.obstacles.leg_touch_nm))
    assert walk.guard.blockage is not None
    assert walk.guard.blockage.towards == pytest.approx(cmath.rect(1.0, -math.pi / 8))


def test_feet_stay_off_what_a_leg_has_met() -> None:
    """A landing beyond the obstacle is moved before it, any other one stays."""
    walk = Walk()
    assert walk.guard.kept_off(2.0 + 2.1j) == 2.0 + 2.1j
    walk.meet(leg(-1.1 * P.obstacles.leg_touch_nm + 0j))
    assert walk.guard.kept_off(2.0 + 2.1j) == pytest.approx(1.1 - P.obstacles.keep_off_m + 2.1j)
    assert walk.guard.kept_off(0.9 + 2.1j) == 0.9 + 2.1j
    # Which way it faces is not known that well.
    aside_m = P.obstacles.keep_off_slope * 0.2
    assert walk.guard.kept_off(2.0 + 1.9j) == pytest.approx(
        1.1 - P.obstacles.keep_off_m + aside_m + 1.9j
    )


def test_between_two_obstacles_it_stands() -> None:
    """What it meets while it steps back ends the retreat."""
    walk = Walk()
    walk.feel(-60.0 + 0j, 0.4)
    assert walk.feel(90.0 + 0j, 0.4).is_zero


def test_a_turn_that_meets_something_ends() -> None:
    """A robot that only turns steps away from what it touches."""
    walk = Walk()
    allowed = walk.feel(60.0j, 0.4, VelocityCommand(0.0, 0.0, 0.5))
    assert allowed.turn_rad_s == 0.0
    assert allowed.left_m_s > 0.0


@pytest.mark.parametrize('mean_tick_s', [0.01, 0.04])
def test_a_force_is_found_at_any_rate(mean_tick_s: float) -> None:
    """A body on which ground and something else push: the estimate comes to be the latter."""
    random, observer, velocity = np.random.default_rng(1), ForceObserver(43.0, 8.0), 0.2 + 0j
    outside_n, ground_n = -50.0 + 20.0j, 30.0 - 10.0j
    time_s = 0.0
    while time_s < 2.0:
        passed_s = float(random.uniform(0.5, 1.5)) * mean_tick_s
        velocity += (outside_n + ground_n) / 43.0 * passed_s
        time_s += passed_s
        observer.update(velocity, ground_n, passed_s)
    assert abs(observer.force_n - outside_n) < 2.0 * math.sqrt(mean_tick_s)
