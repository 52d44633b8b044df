# SPDX-License-Identifier: Apache-2.0
"""Check the installed policy `stand` in physics, as the controllers run it."""

from __future__ import annotations

from humanoid_control.hosting.policies import policy_path
from humanoid_control.policy import Policy
from humanoid_simulation.backend import BackendSettings
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.testing.lockstep_robot import LockstepRobot
import pytest

pytest.importorskip('onnxruntime')

GETS_UP_WITHIN_S = 25.0


@pytest.fixture(name='robot')
def _robot() -> LockstepRobot:
    """Return a robot with noisy sensors that the policy has kept on its feet for a while."""
    robot = LockstepRobot(BackendSettings(noise=REALISTIC, seed=1))
    walking = robot.walking
    walking.use_policy(Policy.load(policy_path('stand'), walking.policy.robot))
    robot.wait(0.2)
    walking.control.manager.switch('policy')
    assert robot.wait(1.5)
    return robot


def test_it_survives_a_push(robot: LockstepRobot) -> None:
    """It stands again afterwards, upright, while somebody moves an arm."""
    robot.push(1.0 + 0.0j, 10.0)
    for _ in range(30):
        robot.walking.control.follow(['left_elbow'], [-1.2])
        assert robot.wait(0.1)
    elbow = robot.backend.joints.index('left_elbow')
    assert robot.backend.observe()[''].positions_rad[elbow] == pytest.approx(-1.2, abs=0.1)
    assert robot.tilt_rad < 0.1
    assert robot.walking.control.manager.mode == 'policy'


def test_it_gets_up(robot: LockstepRobot) -> None:
    """Then the policy goes on, unless a stop forbids it."""
    walking, period_s = robot.walking, robot.backend.period_s
    robot.push(1.0 + 0.0j, 60.0)
    walking.control.hold_still(True)
    for _ in range(round(5.0 / period_s)):
        robot.tick()
    assert walking.walker.phase == 'fallen'
    walking.control.hold_still(False)
    for _ in range(round(GETS_UP_WITHIN_S / period_s)):
        robot.tick()
        if not walking.walker.has_fallen:
            break
    assert robot.wait(2.0) and not walking.walker.has_fallen
    assert robot.tilt_rad < 0.1
    assert walking.control.manager.mode == 'policy'
    assert walking.control.manager.claims.trouble == ''


@pytest.mark.parametrize('mode', [pytest.param('follow', marks=pytest.mark.story), 'hold'])
def test_nothing_watches_for_a_fall_while_joints_are_held(mode: str) -> None:
    """It lies there stiffly, until it is to walk: then it gets up."""
    robot = LockstepRobot(BackendSettings(noise=REALISTIC, seed=1))
    walking, period_s = robot.walking, robot.backend.period_s
    robot.wait(0.2)
    walking.control.manager.switch(mode)
    robot.wait(0.5)
    robot.push(1.0 + 0.0j, 60.0)
    for _ in range(round(8.0 / period_s)):
        robot.tick()
    assert robot.tilt_rad > 1.0
    walking.control.manager.switch('walking')
    for _ in range(round(GETS_UP_WITHIN_S / period_s)):
        robot.tick()
    assert walking.walker.phase == 'stand'
    assert robot.tilt_rad < 0.1


def test_a_fall_is_noticed(robot: LockstepRobot) -> None:
    """The joints give way, and no command moves them; after a reset the policy goes on."""
    robot.push(1.0 + 0.0j, 60.0)
    assert not robot.wait(3.0)
    for _ in range(100):
        robot.tick()
    walking = robot.walking
    assert walking.walker.has_fallen and walking.walker.phase == 'fallen'
    assert 'has fallen' in walking.control.manager.claims.trouble
    sensed = robot.backend.observe()['']
    assert abs(sensed.efforts_nm).max() < 30.0
    robot.reset()
    assert robot.wait(1.0) and not walking.walker.has_fallen
    assert walking.control.manager.claims.trouble == ''
