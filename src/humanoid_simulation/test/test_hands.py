# SPDX-License-Identifier: Apache-2.0
"""Hold a full bottle in the hand of the simulated robot, and walk with it."""

from __future__ import annotations

from collections.abc import Iterator

from humanoid_control.backends import JointTargets
from humanoid_control.controllers import GripResult, TrajectoryPoint, TrajectoryRequest
from humanoid_simulation.backend import EntityState, MujocoBackend
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.backend.settings import BackendSettings
from humanoid_simulation.model import humanoid
from humanoid_simulation.scene import Scene
from humanoid_simulation.scene.scene import Thing
from humanoid_simulation.testing.lockstep_robot import LockstepRobot
import mujoco
import numpy as np
import pytest

BOTTLE = Thing('bottle', 'cylinder', (0.033, 0.22), (0.0, 3.0, 0.11), mass_kg=0.5)
LEVEL_RAD = (0.2, 0.15, 0.0, -1.77, 0.0, 0.0)
"""The upper arm hangs, and the forearm is level, so that what is held stands upright."""


class Hand:
    """The left hand of a robot that stands in a world with a bottle."""

    def __init__(self) -> None:
        """Raise the arm, with the gripper a little wider than the bottle."""
        settings = BackendSettings(noise=REALISTIC, seed=3)
        self.robot = LockstepRobot(settings, Scene(things=(BOTTLE,)), hands=True)
        self.control = self.robot.walking.control
        name = 'left_arm_controller'
        arm = self.control.goals.limbs[name]
        request = TrajectoryRequest(arm.own, [TrajectoryPoint(1.0, LEVEL_RAD)])
        arm.accept(self.control.goals.checked_goal(name, request), lambda end: None)
        self.grip(0.072)
        assert self.robot.wait(2.0)

    @property
    def gap_m(self) -> float:
        """Return the gap between the fingers."""
        return self.control.goals.grippers['left_gripper_controller'].state.gap_m

    @property
    def bottle_m(self) -> np.ndarray:
        """Return where the bottle truly is, (3,) in the gripper."""
        position, rotation = self._frame()
        state = self.robot.backend.entity_state('bottle')
        return np.asarray(rotation.T @ (state.position_m - position))

    def grip(self, gap_m: float, most_n: float = 0.0) -> list[GripResult]:
        """Give the gripper a goal; return where its end comes."""
        name, results = 'left_gripper_controller', list[GripResult]()
        grip = self.control.goals.checked_grip(name, gap_m, most_n)
        self.control.goals.grippers[name].accept(grip, results.append)
        return results

    def take_bottle(self) -> GripResult:
        """Close the fingers around the bottle, which somebody holds there meanwhile."""
        results = self.grip(0.0)
        while not results:
            position, rotation = self._frame()
            upright = rotation @ np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
            turned = np.zeros(4)
            mujoco.mju_mat2Quat(turned, upright.ravel())
            self.robot.backend.set_entity_state('bottle', EntityState(position, turned))
            self.robot.tick()
        return results[0]

    def _frame(self) -> tuple[np.ndarray, np.ndarray]:
        body = self.robot.backend.data.body('robot/l_gripper')
        return body.xpos.copy(), body.xmat.reshape(3, 3).copy()


@pytest.fixture(name='hand')
def _hand() -> Iterator[Hand]:
    """Give a hand that is ready to take something."""
    hand = Hand()
    yield hand
    hand.robot.backend.close()


def test_a_full_bottle_is_held_while_walking(hand: Hand) -> None:
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


def test_an_arm_does_not_sag(hand: Hand) -> None:
    """Its weight is borne wherever it is, level and stretched out too."""
    name = 'left_arm_controller'
    arm = hand.control.goals.limbs[name]
    for posture in (LEVEL_RAD, (-1.2, 0.3, 0.3, -0.4, 0.0, -0.4)):
        request = TrajectoryRequest(arm.own, [TrajectoryPoint(1.0, posture)])
        arm.accept(hand.control.goals.checked_goal(name, request), lambda end: None)
        assert hand.robot.wait(2.0)
        positions_rad = hand.robot.backend.observe()[''].positions_rad[arm.indices]
        # Noise, and the weight of the hand alone at the wrist.
        assert positions_rad == pytest.approx(posture, abs=0.008)


def test_empty_fingers_meet(hand: Hand) -> None:
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
