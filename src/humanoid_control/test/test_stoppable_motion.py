# SPDX-License-Identifier: Apache-2.0
"""Check how a motion is held and released."""

from __future__ import annotations

from itertools import pairwise

from humanoid_control.joint_command import command_of, JointCommand
from humanoid_control.sine_motion import motion_of
from humanoid_control.stoppable_motion import RESUME_S, StoppableMotion
import pytest

MOTION = motion_of(['a', 'b'], [0.5, 0.8], [1.0, 1.5], [0.0, 1.0])
STEP_S = 0.02


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


def test_velocity_is_the_derivative() -> None:
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
