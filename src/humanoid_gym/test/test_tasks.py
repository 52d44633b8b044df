# SPDX-License-Identifier: Apache-2.0
"""Tests of the tasks: what earns a reward, and what ends an episode."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

gymnasium = pytest.importorskip('gymnasium')

import humanoid_gym  # noqa: E402, I100
from humanoid_gym.actions import JointRange  # noqa: E402


def earned(env: Any, action: np.ndarray, steps: int) -> tuple[float, bool]:
    """Return the sum of rewards for the same action again and again, and whether it fell."""
    total, has_fallen = 0.0, False
    for _ in range(steps):
        _, reward, has_fallen, *_ = env.step(action.astype(np.float32))
        total += float(reward)
        if has_fallen:
            break
    return total, has_fallen


def test_the_range_of_joints() -> None:
    """The ends and the home posture are where actions say; both ways round."""
    joints = JointRange(np.array([-1.0, 0.0]), np.array([0.5, 0.5]), np.array([1.0, 2.0]))
    for action in ([-1.0, 1.0], [0.0, 0.0], [0.5, -0.5]):
        positions_rad = joints.positions_rad(np.array(action))
        assert joints.action(positions_rad) == pytest.approx(action)
    assert joints.positions_rad(np.array([-1.0, 1.0])) == pytest.approx([-1.0, 2.0])
    assert joints.positions_rad(np.zeros(2)) == pytest.approx([0.5, 0.5])


def test_walking_as_commanded_earns_more_than_standing() -> None:
    """The robot's own walk, told the commanded velocity, is better than not to move."""
    env = gymnasium.make(humanoid_gym.WALK, actions='velocity').unwrapped
    sums = []
    for forward in (0.3, 0.0):
        observation, _ = env.reset(seed=1, options={'velocity': (0.3, 0.0, 0.0)})
        assert observation[env.layout.slices['command']] == pytest.approx([0.3, 0.0, 0.0])
        total, has_fallen = earned(env, np.array([forward / 0.5, 0.0, 0.0]), 150)
        assert not has_fallen
        sums.append(total)
    assert sums[0] > sums[1] + 0.3


def test_a_push_ends_the_episode() -> None:
    """Joints that only hold their posture do not survive a hard push; a fall costs."""
    env = gymnasium.make(humanoid_gym.STAND, strongest_ns=1000.0).unwrapped
    env.reset(seed=2)
    _, has_fallen = earned(env, np.zeros(23), 400)
    assert has_fallen
    assert env.details()['push_ns'] > 12.0


def test_no_push_is_no_fall() -> None:
    """Without pushes, the servos alone hold the robot on its feet."""
    env = gymnasium.make(humanoid_gym.STAND, strongest_ns=0.0).unwrapped
    env.reset(seed=2)
    total, has_fallen = earned(env, np.zeros(23), 150)
    assert not has_fallen
    assert total > 0.7 * 3.0 * (0.5 + 1.0 + 1.0 + 0.5)


@pytest.mark.parametrize('side', ['left', 'right'])
def test_the_gripper_comes_to_a_target(side: str) -> None:
    """The posture from which a target was drawn reaches it, while the robot stands."""
    env = gymnasium.make(humanoid_gym.REACH, side=side).unwrapped
    turned = 1.0 if side == 'left' else -1.0
    arm_rad = np.array([-0.9, 0.3 * turned, 0.1 * turned, -0.8])
    joints = [f'{side}_{name}' for name in ('shoulder', 'shoulder_roll', 'shoulder_yaw', 'elbow')]
    target_m = env.gripper_m(dict(zip(joints, arm_rad.tolist())))
    assert target_m[0] > 0.1 and (target_m[1] > 0.0) == (side == 'left')
    _, info = env.reset(seed=1, options={'target_m': target_m})
    assert not info['is_success']
    goal = env.actions.range.action(arm_rad)
    for share in np.linspace(0.0, 1.0, 50):  # in a second, as an agent that has learnt it
        env.step((share * goal).astype(np.float32))
    _, has_fallen = earned(env, goal, 25)
    assert not has_fallen
    assert env.details()['is_success']


def test_targets_are_in_reach() -> None:
    """Targets that are drawn are before or beside the body, and differ."""
    env = gymnasium.make(humanoid_gym.REACH).unwrapped
    slices = env.layout.slices['target']
    targets = np.array([env.reset(seed=seed)[0][slices] for seed in range(10)])
    assert np.ptp(targets, axis=0).min() > 0.1
    assert (np.linalg.norm(targets, axis=1) < 0.9).all()
