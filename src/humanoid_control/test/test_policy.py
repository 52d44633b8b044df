# SPDX-License-Identifier: Apache-2.0
"""Check what a policy observes, and how its action becomes targets of joints."""

from __future__ import annotations

from dataclasses import replace
import math
from pathlib import Path

from humanoid_control.policy import PolicyError
from humanoid_control.policy.testing import KD_NM_S_RAD, policy_of, ROBOT
from humanoid_control.testing import LIMITS, observed
from humanoid_description.rotations import quaternion_from_rpy
import numpy as np
import pytest

NO_VELOCITY = np.zeros(3)
KNEE, ELBOW = 2, 0
"""Where the joints of the policy are among those of the robot."""


def terms(*names: str, **others: object) -> dict[str, object]:
    """Return an observation of some terms."""
    return {'terms': [{'name': name} for name in names], **others}


def test_what_is_observed(tmp_path: Path) -> None:
    """Each term in its frame and unit, in the order of the file and of its joints."""
    names = ('base_ang_vel', 'projected_gravity', 'velocity_commands', 'joint_pos_rel',
             'joint_vel_rel', 'last_action')  # fmt: skip
    policy, network = policy_of(tmp_path, lambda o: [0.3, -0.4], observation=terms(*names))
    pitch_rad = 0.2
    observation = replace(
        observed(0.0, 0.5, 0.0, 0.7),
        orientation=quaternion_from_rpy(0.0, pitch_rad, 1.0),
        angular_velocity_rad_s=np.array([1.0, 2.0, 3.0]),
        velocities_rad_s=np.array([4.0, 5.0, 6.0]),
    )
    policy.decide(observation, np.array([0.1, 0.2, 0.3]))
    policy.decide(observation, NO_VELOCITY)
    first, second = network.observed
    assert first == pytest.approx(
        [1.0, 2.0, 3.0, math.sin(pitch_rad), 0.0, -math.cos(pitch_rad), 0.1, 0.2, 0.3,
         0.7 - 0.2, 0.5 + 0.1, 6.0, 4.0, 0.0, 0.0]
    )  # fmt: skip
    assert second[-2:] == pytest.approx([0.3, -0.4])


def test_the_imu_is_turned_into_the_base(tmp_path: Path) -> None:
    """A sensor that looks to the left measures along y what the base does along x."""
    to_base = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    robot = replace(ROBOT, imu_in_base=to_base)
    policy, network = policy_of(
        tmp_path, lambda o: [0.0, 0.0], robot, observation=terms('base_ang_vel')
    )
    turning = replace(observed(0.0), angular_velocity_rad_s=np.array([0.0, -1.0, 0.0]))
    policy.decide(turning, NO_VELOCITY)
    assert network.observed[0] == pytest.approx([1.0, 0.0, 0.0])


def test_values_are_clipped_and_scaled(tmp_path: Path) -> None:
    """First clipped, then scaled; the clip of the whole observation comes last."""
    term = {'name': 'joint_pos_rel', 'clip': [-0.3, 0.4], 'scale': [1.0, 10.0]}
    policy, network = policy_of(
        tmp_path, lambda o: [0.0, 0.0], observation={'terms': [term], 'clip': 2.5}
    )
    policy.decide(observed(0.0, -1.1, 0.0, 0.9), NO_VELOCITY)
    assert network.observed[0] == pytest.approx([0.4, -2.5])


@pytest.mark.parametrize(
    ('order', 'third'), [('by_term', [0.1, 0.2, 1.0, 2.0]), ('by_step', [0.1, 1.0, 0.2, 2.0])]
)
def test_the_history(tmp_path: Path, order: str, third: list[float]) -> None:
    """The oldest step first; the first observation fills it; a reset forgets it."""
    policy, network = policy_of(
        tmp_path,
        lambda o: [0.0],
        joints=['left_knee'],
        default_rad=0.0,
        observation=terms('joint_pos_rel', 'joint_vel_rel', history_length=2, history_order=order),
    )

    def decide(knee_rad: float) -> None:
        observation = observed(0.0, 0.0, 0.0, knee_rad)
        moving = replace(observation, velocities_rad_s=10.0 * observation.positions_rad)
        policy.decide(moving, NO_VELOCITY)

    for knee_rad in (0.0, 0.1, 0.2):
        decide(knee_rad)
    policy.reset()
    decide(0.5)
    assert network.observed[2] == pytest.approx(third)
    assert sorted(network.observed[3].tolist()) == pytest.approx([0.5, 0.5, 5.0, 5.0])


def test_an_action_is_around_the_default_pose(tmp_path: Path) -> None:
    """Scaled, clipped, and within the range of the joint; without gains, those of the robot."""
    policy, _ = policy_of(
        tmp_path, lambda o: [0.5, -9.0], action={'scale_rad': [0.4, 0.5], 'clip': [-4.5, 1.0]}
    )
    observation = observed(0.0)
    assert policy.targets_rad(observation) == pytest.approx([0.2, -0.1])
    policy.decide(observation, NO_VELOCITY)
    assert policy.targets_rad(observation) == pytest.approx([0.2 + 0.4 * 0.5, -2.0])


def test_gains_of_the_policy(tmp_path: Path) -> None:
    """The servo exerts the torque that one with the gains of the policy would."""
    kp, kd = np.array([20.0, 90.0]), np.array([0.5, 4.0])
    policy, _ = policy_of(
        tmp_path, lambda o: [0.2, 0.4], kp_nm_rad=kp.tolist(), kd_nm_s_rad=kd.tolist()
    )
    observation = replace(
        observed(0.0, 0.05, 0.0, 0.1), velocities_rad_s=np.array([0.7, 0.0, -0.9])
    )
    policy.decide(observation, NO_VELOCITY)
    at_rad, speeds = observation.positions_rad[[KNEE, ELBOW]], np.array([-0.9, 0.7])
    servo_nm = LIMITS.kp_nm_rad[:2] * (policy.targets_rad(observation) - at_rad)
    servo_nm -= KD_NM_S_RAD[:2] * speeds
    wanted_rad = np.array([0.2 + 0.1, -0.1 + 0.2])
    assert servo_nm == pytest.approx(kp * (wanted_rad - at_rad) - kd * speeds)


def test_the_torque_limit(tmp_path: Path) -> None:
    """A far target exerts no more than the limit."""
    policy, _ = policy_of(tmp_path, lambda o: [1.0, 1.0], torque_limit_nm=3.0)
    observation = observed(0.0)
    policy.decide(observation, NO_VELOCITY)
    torque_nm = LIMITS.kp_nm_rad[:2] * policy.targets_rad(observation)
    assert torque_nm == pytest.approx([3.0, 3.0])


def test_an_action_that_is_not_finite(tmp_path: Path) -> None:
    """Names the joint, and leaves the targets as they were."""
    answers = iter([[0.1, 0.1], [0.1, math.nan]])
    policy, _ = policy_of(tmp_path, lambda o: next(answers))
    policy.decide(observed(0.0), NO_VELOCITY)
    before = policy.targets_rad(observed(0.0))
    with pytest.raises(PolicyError, match="network returned nan for 'left_elbow'"):
        policy.decide(observed(0.0), NO_VELOCITY)
    assert policy.targets_rad(observed(0.0)).tolist() == before.tolist()


def test_joints_of_a_robot_with_a_prefix(tmp_path: Path) -> None:
    """The names in the file have none."""
    robot = replace(ROBOT, joints=tuple(f'a_{joint}' for joint in ROBOT.joints), prefix='a_')
    policy, _ = policy_of(tmp_path, lambda o: [0.0, 0.0], robot)
    assert policy.indices.tolist() == [KNEE, ELBOW]


def test_joints_that_do_not_fit(tmp_path: Path) -> None:
    """One that the robot lacks, and a default pose that it cannot take."""
    with pytest.raises(PolicyError, match="no joint 'left_nee'. Did you mean 'left_knee'?"):
        policy_of(tmp_path, lambda o: [0.0], joints=['left_nee'], default_rad=0.0)
    with pytest.raises(
        PolicyError, match="'left_knee' is 3 rad, but the joint moves from -2 to 1"
    ):
        policy_of(tmp_path, lambda o: [0.0], joints=['left_knee'], default_rad=3.0)
