# SPDX-License-Identifier: Apache-2.0
"""Check the motion of the joints, and how it is held and released."""

from __future__ import annotations

from itertools import pairwise
import math

from humanoid_control.joint_controller import JointControllerParameters
from humanoid_control.sine_motion import (
    command_of,
    JointCommand,
    motion_of,
    RESUME_S,
    Sinusoid,
    StoppableMotion,
)
import pytest

TIMES_S = [0.0, 0.1, 1.0, 2.5, 100.0]
SWING = Sinusoid('elbow', 0.8, 1.5, 0.3)
MOTION = motion_of(['a', 'b'], [0.5, 0.8], [1.0, 1.5], [0.0, 1.0])
STEP_S = 0.02


@pytest.mark.parametrize('now_s', TIMES_S)
def test_default_positions(now_s: float) -> None:
    """The left arm follows the sines of the book, the right one half a period later."""
    positions = JointControllerParameters().motion.positions_rad(now_s)
    left = [0.5 * math.sin(now_s), 0.8 * math.sin(1.5 * now_s)]
    assert positions == pytest.approx([*left, -left[0], -left[1]], abs=1e-9)


@pytest.mark.parametrize('now_s', TIMES_S)
def test_velocity_is_the_derivative(now_s: float) -> None:
    """The velocity is the slope of the position."""
    step_s = 1e-6
    slope = (SWING.position_rad(now_s + step_s) - SWING.position_rad(now_s - step_s)) / 2e-6
    assert SWING.velocity_rad_s(now_s) == pytest.approx(slope, abs=1e-6)


def test_frequency_changes_without_a_jump() -> None:
    """With a new frequency, a joint goes on from where it is, but faster."""
    now_s = 12.3
    faster = SWING.followed_by(Sinusoid('elbow', 0.8, 3.0, 0.3), now_s)
    assert faster.position_rad(now_s) == pytest.approx(SWING.position_rad(now_s))
    assert faster.velocity_rad_s(now_s) == pytest.approx(2 * SWING.velocity_rad_s(now_s))


def test_phase_changes_by_the_difference() -> None:
    """A new phase turns the joint on by the difference."""
    now_s = 12.3
    shifted = SWING.followed_by(Sinusoid('elbow', 0.8, 1.5, 0.3 + math.pi), now_s)
    assert shifted.position_rad(now_s) == pytest.approx(-SWING.position_rad(now_s))


def test_nothing_changes_without_a_change() -> None:
    """Handing over to the same motion leaves all as it is, however often."""
    swing = SWING
    for now_s in (1.0, 2.0, 50.0):
        swing = swing.followed_by(SWING, now_s)
    assert swing.position_rad(60.0) == pytest.approx(SWING.position_rad(60.0))


def test_motion_hands_over_by_name() -> None:
    """Joints that stay go on, whatever their place in the list; new ones join in."""
    old = motion_of(['a', 'b'], [1.0, 1.0], [1.0, 2.0], [0.0, 0.0])
    new = old.followed_by(motion_of(['b', 'c'], [1.0, 1.0], [5.0, 1.0], [0.0, 0.0]), 3.0)
    assert new.joints == ['b', 'c']
    assert new.positions_rad(3.0) == pytest.approx([math.sin(6.0), math.sin(3.0)])


def run(
    motion: StoppableMotion, from_s: float, to_s: float, hold: bool = False
) -> list[JointCommand]:
    """Return the commands of a time."""
    steps = round((to_s - from_s) / STEP_S)
    commands = [motion.command(from_s + step * STEP_S, hold) for step in range(steps)]
    assert all(commands)
    return [command for command in commands if command]


def fastest(commands: list[JointCommand]) -> float:
    """Return the greatest speed that a step between two commands needs."""
    return max(
        abs(to - was) / STEP_S
        for before, after in pairwise(commands)
        for was, to in zip(before.positions_rad, after.positions_rad)
    )


def test_moves_as_before() -> None:
    """What is never held is the motion."""
    assert run(StoppableMotion(MOTION), 0.0, 5.0)[-1] == command_of(MOTION, 4.98)


def test_holds_the_last_position() -> None:
    """What is held stays where the last command was, with velocity zero."""
    motion = StoppableMotion(MOTION)
    last = run(motion, 0.0, 3.0)[-1]
    for command in run(motion, 3.0, 5.0, hold=True):
        assert command == JointCommand(['a', 'b'], last.positions_rad, [0.0, 0.0])


def test_held_from_the_start() -> None:
    """Joints that never had a command get none while they are held."""
    motion = StoppableMotion(MOTION)
    assert motion.command(0.0, hold=True) is None
    assert motion.command(0.02, hold=False) is not None


def test_goes_on_without_a_jump() -> None:
    """After the release position and velocity go on steadily, into the motion as it was."""
    motion = StoppableMotion(MOTION)
    commands = run(motion, 0.0, 3.0)
    held = run(motion, 3.0, 13.0, hold=True)
    after = run(motion, 13.0, 20.0)
    assert fastest([*commands, *held, *after]) < 1.6, 'the motion itself has up to 1.2 rad/s'
    assert after[0].velocities_rad_s == pytest.approx([0.0, 0.0], abs=0.05)
    for before, later in pairwise(after):
        assert later.velocities_rad_s == pytest.approx(before.velocities_rad_s, abs=0.1)
    assert after[-1].positions_rad == pytest.approx(command_of(MOTION, 9.98).positions_rad)


def test_velocity_is_the_derivative_after_a_release() -> None:
    """On the way into the motion the velocity is the slope of the position."""
    motion = StoppableMotion(MOTION)
    run(motion, 0.0, 1.0)
    run(motion, 1.0, 2.0, hold=True)
    after = run(motion, 2.0, 2.0 + RESUME_S)
    for before, at, later in zip(after, after[1:], after[2:]):
        slope = (later.positions_rad[0] - before.positions_rad[0]) / (2 * STEP_S)
        assert at.velocities_rad_s[0] == pytest.approx(slope, abs=1e-3)


def test_change_while_held() -> None:
    """A new motion moves no joint that is held, and is gone into without a jump."""
    motion = StoppableMotion(MOTION)
    run(motion, 0.0, 3.0)
    held = run(motion, 3.0, 4.0, hold=True)
    motion.change(motion_of(['a', 'b'], [3.0, 3.0], [0.1, 0.1], [2.0, 2.0]), 4.0)
    assert run(motion, 4.0, 5.0, hold=True) == [held[-1]] * 50
    after = run(motion, 5.0, 5.0 + 2 * RESUME_S)
    assert fastest([held[-1], *after]) < 4.5 / RESUME_S * 1.5


def test_held_again_on_the_way() -> None:
    """A second stop before the joints are in their motion holds them where they are."""
    motion = StoppableMotion(MOTION)
    run(motion, 0.0, 1.0)
    run(motion, 1.0, 2.0, hold=True)
    last = run(motion, 2.0, 2.0 + RESUME_S / 2)[-1]
    held = run(motion, 4.0, 5.0, hold=True)
    after = run(motion, 5.0, 6.0)
    assert held[0].positions_rad == held[-1].positions_rad == last.positions_rad
    assert fastest([held[-1], *after]) < 1.6
