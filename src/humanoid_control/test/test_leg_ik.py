# SPDX-License-Identifier: Apache-2.0
"""Check the joints of a leg, and their rates, for poses and motions of its foot."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from humanoid_control.dynamics import (
    BodyModel,
    DynamicsError,
    Frame,
    leg_posture,
    leg_rates,
    LegGeometry,
    Twist,
)
from humanoid_description.drives import load_drives
from humanoid_description.robot import Robot
from humanoid_description.rotations import exp, from_rpy
import numpy as np
import pytest

Array = np.ndarray[Any, Any]
POSTURES = 500
# The knee bends at least so far where the leg is not yet held back from stretching.
BENT_RAD = 0.13
STEP_S = 1e-6
LINEAR, ANGULAR = np.array([0.3, -0.2, 0.5]), np.array([0.1, 0.4, -0.3])


class Leg:
    """A leg of a robot, and where its joints take its sole."""

    def __init__(self, robot: Robot, side: str) -> None:
        """Read the leg."""
        self.geometry = LegGeometry.of(robot, side)
        self.model = BodyModel.of(robot, self.geometry.joints)

    def sole(self, positions: Any) -> Frame:
        """Return where the sole is in the root."""
        state = self.model.state(np.eye(3), np.zeros(3), np.asarray(positions), np.zeros(6))
        sole = self.geometry.sole
        return Frame(state.position_m(sole), state.rotation(sole))

    def random_postures(self) -> Array:
        """Return postures within the limits whose knee is bent, one a row."""
        drives = load_drives()
        chosen = [drives[joint] for joint in self.geometry.joints]
        lower, upper = np.array([(d.lower, d.upper) for d in chosen]).T
        lower[3] = BENT_RAD
        return np.random.default_rng(6).uniform(lower, upper, (POSTURES, 6))

    def leg_vector(self, positions: Any) -> Array:
        """Return the way from hip to ankle in the root."""
        sole = self.sole(positions)
        return sole.position_m + sole.rotation @ self.geometry.ankle_m - self.geometry.hip_m


@pytest.fixture(name='leg', params=['left', 'right'])
def _leg(robot: Robot, request: pytest.FixtureRequest) -> Leg:
    """Return each leg in turn."""
    return Leg(robot, request.param)


@pytest.mark.parametrize('scale', [0.5, 1.0, 1.3], indirect=True)
def test_round_trip(leg: Leg) -> None:
    """Every posture within the limits is found again from the pose of the sole."""
    for positions in leg.random_postures():
        posture = leg_posture(leg.geometry, leg.sole(positions))
        assert posture.positions_rad == pytest.approx(positions, rel=0, abs=1e-9)
        assert (posture.beyond_m, posture.give) == (0.0, 1.0)


def test_mirrored(robot: Robot) -> None:
    """The right leg does what the left one does, with rolls and yaws the other way."""
    left, right = Leg(robot, 'left'), Leg(robot, 'right')
    mirror = np.diag([1.0, -1.0, 1.0])
    for positions in left.random_postures()[:50]:
        sole = left.sole(positions)
        other = Frame(mirror @ sole.position_m, mirror @ sole.rotation @ mirror)
        found = leg_posture(right.geometry, other).positions_rad
        assert found == pytest.approx(positions * (-1, -1, 1, 1, 1, -1), abs=1e-9)


@pytest.mark.parametrize('distance_m', [0.6, 0.61, 0.8, 5.0])
def test_beyond_reach(leg: Leg, distance_m: float) -> None:
    """Beyond reach the leg is stretched towards the ankle's place; the sole turns as asked."""
    direction = np.array([0.3, 0.1, -0.9]) / np.linalg.norm([0.3, 0.1, -0.9])
    rotation = from_rpy(0.1, -0.2, 0.3)
    ankle = leg.geometry.hip_m + distance_m * direction
    posture = leg_posture(leg.geometry, Frame(ankle - rotation @ leg.geometry.ankle_m, rotation))
    stretched = leg.leg_vector(posture.positions_rad)
    length_m = float(np.linalg.norm(stretched))
    assert length_m == pytest.approx(leg.geometry.length_m, rel=1e-3)
    assert length_m <= leg.geometry.length_m + 1e-12
    assert posture.beyond_m == pytest.approx(distance_m - length_m) and posture.beyond_m > 0
    assert stretched / length_m == pytest.approx(direction, abs=1e-9)
    assert leg.sole(posture.positions_rad).rotation == pytest.approx(rotation, abs=1e-9)


def test_reach_ends_smoothly(leg: Leg) -> None:
    """On the way out the knee stretches ever further and has no kink."""
    hip = leg.geometry.hip_m
    depths_m = np.arange(0.59, 0.62, 1e-5)
    knees = np.array(
        [
            leg_posture(
                leg.geometry, Frame(hip - (0.0, 0.0, depth + 0.07), np.eye(3))
            ).positions_rad[3]
            for depth in depths_m
        ]
    )
    rates = np.diff(knees)
    assert (rates < 0).all() and knees[-1] > 0
    assert np.abs(np.diff(rates)).max() < 0.02 * np.abs(rates).max()


def test_sole_at_the_hip(leg: Leg) -> None:
    """A place that no leg can fold to gives finite joints, and is reported."""
    sole = Frame(leg.geometry.hip_m - leg.geometry.ankle_m, np.eye(3))
    posture = leg_posture(leg.geometry, sole)
    assert np.isfinite(posture.positions_rad).all()


def test_unequal_lengths_fold_only_so_far(robot: Robot) -> None:
    """With a longer thigh the ankle cannot come to the hip: it stays as near as it gets."""
    leg = replace(LegGeometry.of(robot, 'left'), thigh_m=0.35, shank_m=0.25)
    sole = Frame(leg.hip_m - leg.ankle_m - (0.0, 0.0, 0.06), np.eye(3))
    posture = leg_posture(leg, sole)
    assert posture.beyond_m == pytest.approx(-0.04) and posture.give == 0.0
    assert posture.positions_rad[3] == pytest.approx(np.pi)


@pytest.mark.parametrize('bad', [np.nan, np.inf])
def test_not_finite(leg: Leg, bad: float) -> None:
    """A place that is none is refused."""
    with pytest.raises(DynamicsError, match='give finite numbers'):
        leg_posture(leg.geometry, Frame(np.array([0.0, bad, -0.7]), np.eye(3)))
    with pytest.raises(DynamicsError, match='give finite numbers'):
        leg_posture(leg.geometry, Frame(np.array([0.0, 0.1, -0.7]), np.full((3, 3), bad)))


@pytest.mark.parametrize('side', ['left', 'right'])
def test_rates_are_found_again(robot: Robot, side: str) -> None:
    """The rates that move a sole are found from its motion."""
    leg, generator = LegGeometry.of(robot, side), np.random.default_rng(7)
    model = BodyModel.of(robot, leg.joints)
    for _ in range(200):
        positions = generator.uniform(
            [-0.8, -0.6, -1.9, 0.2, -1, -0.5], [0.8, 0.6, 0.9, 2, 0.9, 0.5]
        )
        rates = generator.normal(size=6)
        state = model.state(np.eye(3), np.zeros(3), positions, rates)
        sole = Frame(state.position_m(leg.sole), state.rotation(leg.sole))
        twist = Twist(state.velocity_m_s(leg.sole), state.angular_velocity_rad_s(leg.sole))
        found = leg_rates(leg, leg_posture(leg, sole), sole, twist)
        assert found == pytest.approx(rates, rel=0, abs=1e-7)


@pytest.mark.parametrize('drop_m', [0.55, 0.598, 0.5985, 0.599, 0.6, 0.603, 0.607, 0.61])
def test_rates_are_the_derivative(robot: Robot, drop_m: float) -> None:
    """Within and beyond reach the rates are the derivative of the posture."""
    leg = LegGeometry.of(robot, 'left')
    rotation = from_rpy(0.1, -0.2, 0.3)
    place = leg.hip_m + drop_m * np.array([0.28, 0.0, -0.96]) - rotation @ leg.ankle_m

    def posture_at(time_s: float) -> Array:
        moved = Frame(place + LINEAR * time_s, exp(ANGULAR * time_s) @ rotation)
        return np.array(leg_posture(leg, moved).positions_rad)

    sole = Frame(place, rotation)
    found = leg_rates(leg, leg_posture(leg, sole), sole, Twist(LINEAR, ANGULAR))
    derivative = (posture_at(STEP_S) - posture_at(-STEP_S)) / (2 * STEP_S)
    assert found == pytest.approx(derivative, abs=1e-5)


@pytest.mark.parametrize('drop_m', [0.0, 0.6, 1.0, 10.0])
def test_rates_stay_finite(robot: Robot, drop_m: float) -> None:
    """A leg that is stretched far beyond its reach, or folded up, has finite rates."""
    leg = LegGeometry.of(robot, 'left')
    sole = Frame(leg.hip_m - leg.ankle_m - (0.0, 0.0, drop_m), np.eye(3))
    rates = leg_rates(leg, leg_posture(leg, sole), sole, Twist(LINEAR, ANGULAR))
    assert np.abs(rates).max() < 100.0
