# SPDX-License-Identifier: Apache-2.0
"""
Which policies does the training of balance choose from? Symmetric linear ones of the legs.

Each target is the home posture plus a linear feedback of what sways: fore and aft for the pitch
joints, to the sides for the roll joints. Both legs do the same, so that a few gains are enough.
That linear policies can do much is shown by H. Mania, A. Guy and B. Recht, "Simple random search
of static linear policies is competitive for reinforcement learning", NeurIPS 2018.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from humanoid_common.onnx_file import onnx_model, Operation, Tensor
from humanoid_control.backends import Array
from humanoid_description.drives import leg_joints, load_drives, SIDES
from humanoid_gym.actions import MOST_RAD
from humanoid_simulation.files import replace_file
import numpy as np
import yaml

JOINTS = leg_joints()
"""The joints that the policy moves, in its order."""
TILT_RAD, RATE_RAD_S, ANGLE_RAD, SPEED_RAD_S = 0.1, 1.0, 0.1, 1.0
"""What a gain refers to: a gain of 1 answers such a deviation with an action of 1."""


@dataclass(frozen=True)
class Plane:
    """A plane in which the robot sways: the axes of the sensors that notice, and the joints."""

    gravity: int
    """Index of the component of gravity, in the base."""
    rate: int
    """Index of the component of the angular velocity, in the base."""
    joints: tuple[str, ...]

    @property
    def size(self) -> int:
        """Return the number of gains: of each joint, one for each signal."""
        return len(self.joints) * (2 + 2 * len(self.joints))


PLANES = (Plane(0, 1, ('hip_pitch', 'ankle_pitch')), Plane(1, 0, ('hip_roll', 'ankle_roll')))
GAINS = sum(plane.size for plane in PLANES)
"""How many gains there are."""
HEADER = """\
# A policy of the legs that keeps the balance on the spot; the README of humanoid_control explains
# the file. It was written by `ros2 run humanoid_gym train_balance`.
"""
TERMS = {
    'base_ang_vel': 3,
    'projected_gravity': 3,
    'joint_pos_rel': len(JOINTS),
    'joint_vel_rel': len(JOINTS),
}
"""What the policy observes, with the number of values."""


def initial_gains() -> Array:
    """Return gains that push the toes down when the robot leans forward, and so to the sides."""
    gains = np.zeros(GAINS)
    fore_and_aft, sideways = np.split(gains, [PLANES[0].size])
    fore_and_aft.reshape(2, -1)[1, :2] = 0.1, 0.1
    sideways.reshape(2, -1)[1, :2] = -0.1, 0.1
    return gains


def weights_of(gains: Array) -> Array:
    """
    Arrange gains as the matrix of the policy.

    Parameters
    ----------
    gains
        The gains (GAINS,).

    Returns
    -------
    Array
        Weights (joints, observation), each in the order of `JOINTS` and `TERMS`.

    """
    weights = np.zeros((len(JOINTS), sum(TERMS.values())))
    rates, gravity, angles, speeds = np.split(weights, np.cumsum(list(TERMS.values()))[:-1], 1)
    start = 0
    for plane in PLANES:
        block = np.reshape(gains[slice(start, start + plane.size)], (len(plane.joints), -1))
        start += plane.size
        for joint, row in zip(plane.joints, block, strict=True):
            own = _both(joint)
            gravity[own, plane.gravity] = row[0] / TILT_RAD
            rates[own, plane.rate] = row[1] / RATE_RAD_S
            of_angles, of_speeds = np.split(row[2:], 2)
            for other, angle, speed in zip(plane.joints, of_angles, of_speeds, strict=True):
                both = np.ix_(own, _both(other))
                angles[both] = angle / ANGLE_RAD / len(SIDES)
                speeds[both] = speed / SPEED_RAD_S / len(SIDES)
    return weights


def _both(joint: str) -> list[int]:
    """Return where a joint is among `JOINTS`, on the left and on the right."""
    return [JOINTS.index(f'{side}_{joint}') for side in SIDES]


class BalancePolicy:
    """
    The policy in an environment of `humanoid_gym`, which observes and moves all joints.

    Parameters
    ----------
    slices
        Where each part of the observation is.
    joints
        All joints of the robot, in their order.

    Attributes
    ----------
    weights
        Weights (joints, observation), as from `weights_of`; zero to begin with.

    """

    def __init__(self, slices: Mapping[str, slice], joints: Sequence[str]) -> None:
        indices = [joints.index(joint) for joint in JOINTS]
        everything = np.arange(max(each.stop for each in slices.values()))
        self._observed = np.concatenate(
            [
                everything[slices['angular_velocity']],
                everything[slices['gravity']],
                everything[slices['joint_positions']][indices],
                everything[slices['joint_velocities']][indices],
            ]
        )
        self._moved = indices
        self._action = np.zeros(len(joints), dtype=np.float32)
        self.weights = np.zeros((len(JOINTS), len(self._observed)))

    def action(self, observation: Array) -> Array:
        """
        Compute the action.

        Parameters
        ----------
        observation
            The observation of the environment.

        Returns
        -------
        Array
            From -1 to 1, for all joints; zero for those that the policy does not move.

        """
        action: Array = self._action.copy()
        action[self._moved] = np.tanh(self.weights @ observation[self._observed])
        return action


def write_policy(
    folder: Path, gains: Array, home_rad: Mapping[str, float], rate_hz: float
) -> None:
    """
    Write a policy as stand.onnx and stand.yaml, for the mode `policy` of the controllers.

    Parameters
    ----------
    folder
        An existing folder.
    gains
        The gains (GAINS,).
    home_rad
        The home posture, by joint.
    rate_hz
        Steps of the environment in a second.

    Raises
    ------
    SimulationError
        A file cannot be written; one that was there is still whole.

    """
    size = sum(TERMS.values())
    network = onnx_model(
        'stand',
        [
            Operation('MatMul', ['observation', 'weights'], 'feedback'),
            Operation('Tanh', ['feedback'], 'action'),
        ],
        {'weights': weights_of(gains).T.astype(np.float32)},
        [Tensor('observation', [1, size])],
        [Tensor('action', [1, len(JOINTS)])],
    )
    drives = load_drives()
    content = {
        'model': 'stand.onnx',
        'rate_hz': rate_hz,
        'joints': list(JOINTS),
        'default_rad': {joint: round(home_rad[joint], 6) for joint in JOINTS},
        'kp_nm_rad': {joint: drives[joint].kp for joint in JOINTS},
        'kd_nm_s_rad': {joint: drives[joint].kd for joint in JOINTS},
        'action': {'scale_rad': MOST_RAD, 'clip': [-1.0, 1.0]},
        'observation': {'terms': [{'name': name} for name in TERMS]},
    }
    text = yaml.safe_dump(content, sort_keys=False)
    replace_file(folder / 'stand.onnx', network)
    replace_file(folder / 'stand.yaml', f'{HEADER}{text}'.encode())
