# SPDX-License-Identifier: Apache-2.0
"""Hold a full bottle in the hand of the simulated robot, and walk with it."""

from __future__ import annotations

from collections.abc import Iterator

from humanoid_control.backends import JointTargets
from humanoid_simulation.backend import MujocoBackend
from humanoid_simulation.model import humanoid
from humanoid_simulation.testing.lockstep_hand import LEVEL_RAD, LockstepHand
import numpy as np
import pytest


@pytest.fixture(name='hand')
def _hand() -> Iterator[LockstepHand]:
    """Give a hand that is ready to take something."""
    hand = LockstepHand()
    yield hand
    hand.robot.backend.close()


def test_a_full_bottle_is_held_while_walking(hand: LockstepHand) -> None:
    """Half a kilogram, ahead, sideways and round a corner; and then it is let go."""
    end = hand.take_bottle()
    assert end.has_ended_well and end.state.stalled
    assert end.state.gap_m == pytest.approx(0.066, abs=0.004)
    assert hand.robot.wait(0.5)
    before_m = hand.bottle_m
    for velocity in ((0.3, 0.0, 0.0), (0.2, 0.0, 0.4), (0.0, 0.1, 0.0), (0.0, 0.0, 0.0)):
        hand.robot.drive(*velocity)
        assert hand.robot.wait(2.0)
    assert hand.bottle_m == pytest.approx(before_m, abs=0.0015)
    assert hand.gap_m == pytest.approx(0.066, abs=0.004)
    hand.grip(0.1)
    assert hand.robot.wait(1.0)
    assert float(hand.robot.backend.entity_state('bottle').position_m[2]) < 0.2


def test_an_arm_does_not_sag(hand: LockstepHand) -> None:
    """Its weight is borne wherever it is, level and stretched out too."""
    for posture in (LEVEL_RAD, (-1.2, 0.3, 0.3, -0.4, 0.0, -0.4)):
        hand.move_arm(posture)
        assert hand.robot.wait(2.0)
        # Noise, and the weight of the hand alone at the wrist.
        assert hand.arm_rad == pytest.approx(posture, abs=0.008)


def test_empty_fingers_meet(hand: LockstepHand) -> None:
    """The gap tells that nothing is held."""
    results = hand.grip(0.0)
    assert hand.robot.wait(1.5)
    (end,) = results
    assert end.state.reached_goal and end.state.gap_m == pytest.approx(0.0, abs=0.003)


def test_the_thumb_mirrors_the_finger() -> None:
    """Also when the robot is put somewhere else, and with a prefix."""
    backend = MujocoBackend(humanoid(prefix='r1_', hands=True))
    names = backend.joints
    targets = backend.observe()['']
    wanted = targets.positions_rad.copy()
    wanted[names.index('r1_right_gripper')] = 0.04
    for _ in range(100):
        backend.step({'': JointTargets(wanted, np.zeros_like(wanted), np.zeros_like(wanted))})
    data = backend.data
    finger, thumb = (
        float(data.joint(f'robot/r1_right_gripper{part}').qpos[0]) for part in ('', '_thumb')
    )
    assert finger == pytest.approx(0.04, abs=0.002)
    assert thumb == pytest.approx(finger, abs=0.001)
    backend.reset()
    assert float(backend.data.joint('robot/r1_right_gripper_thumb').qpos[0]) == 0.0


def test_without_hands_nothing_has_changed() -> None:
    """Neither joints nor the way in which friction is computed."""
    bare, handed = MujocoBackend(), MujocoBackend(humanoid(hands=True))
    assert len(handed.joints) - len(bare.joints) == 6
    assert bare.model.opt.impratio == 10.0
    assert bare.model.neq == 0
