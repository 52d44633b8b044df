# SPDX-License-Identifier: Apache-2.0
"""Check that a robot that lies gets up by itself, in physics and with noise."""

from __future__ import annotations

import math

from humanoid_simulation.backend import BackendSettings
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.keyframes import Keyframe
from humanoid_simulation.testing.lockstep_robot import LockstepRobot
import pytest

WITHIN_S = 15.0
LIMBS = {'left_shoulder_roll': 0.4, 'right_shoulder': -0.3, 'left_knee': 0.3, 'waist_yaw': 0.1}


@pytest.mark.parametrize(
    ('roll_rad', 'pitch_rad', 'hands'),
    [
        pytest.param(0.0, -math.pi / 2, False, marks=pytest.mark.story),
        (0.0, math.pi / 2, False),
        pytest.param(-math.pi / 2, 0.1, False, marks=pytest.mark.story),
        pytest.param(math.pi / 2, 0.1, False, marks=pytest.mark.story),
        pytest.param(0.0, -math.pi / 2, True, marks=pytest.mark.story),
    ],
    ids=['back', 'face', 'left', 'right', 'hands'],
)
def test_it_gets_up(roll_rad: float, pitch_rad: float, hands: bool) -> None:
    """It goes limp, lies a while, stands within the time, and stays on its feet."""
    lying = Keyframe(LIMBS, roll_rad, pitch_rad)
    robot = LockstepRobot(
        BackendSettings(noise=REALISTIC, seed=1), hands=hands, keyframes={'lying': lying}
    )
    robot.reset('lying')
    walker, fall = robot.walking.walker, robot.walking.walker.parameters.fall
    robot.tick()
    assert walker.phase == 'fallen'
    for _ in range(round((fall.collapse_s + fall.lie_s + WITHIN_S) / robot.backend.period_s)):
        robot.tick()
        if not walker.has_fallen:
            break
    assert walker.phase == 'stand'
    for _ in range(round(1.0 / robot.backend.period_s)):
        robot.tick()
    assert walker.phase == 'stand'
    assert robot.truth.position_m[2] > 0.65
    assert robot.tilt_rad < 0.1
