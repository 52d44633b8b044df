# SPDX-License-Identifier: Apache-2.0
"""A policy for the robot with three joints, whose network is a function."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from humanoid_control.policy import Policy, PolicyRobot
from humanoid_control.policy.policy_file import read_policy_file
from humanoid_control.testing import JOINTS, LIMITS
import numpy as np
import yaml

KD_NM_S_RAD = np.full(3, 1.8)
ROBOT = PolicyRobot(JOINTS, '', LIMITS, KD_NM_S_RAD, np.eye(3))
CONTENT: dict[str, Any] = {
    'model': 'moves.onnx',
    'rate_hz': 50.0,
    'joints': ['left_knee', 'left_elbow'],
    'default_rad': {'left_knee': 0.2, 'left_elbow': -0.1},
    'action': {'scale_rad': 0.5},
    'observation': {'terms': [{'name': 'joint_pos_rel'}, {'name': 'last_action'}]},
}


class FakeNetwork:
    """
    A network that is a function of what it observes, and remembers that.

    Parameters
    ----------
    answer
        From an observation (n,) to the action (m,).

    """

    def __init__(self, answer: Callable[[np.ndarray], Any]) -> None:
        self._answer = answer
        self.observed: list[np.ndarray] = []

    def run(self, observation: np.ndarray) -> np.ndarray:
        """
        Return the answer.

        Parameters
        ----------
        observation
            The observation (1, n).

        """
        self.observed.append(observation[0])
        return np.asarray(self._answer(observation[0]), dtype=np.float64)


def write(folder: Path, **changes: Any) -> Path:
    """
    Write a policy file with changes, and return its path.

    Parameters
    ----------
    folder
        Where to write it.
    **changes
        Other values of its keys; one that is None leaves the key out.

    """
    content = {key: value for key, value in {**CONTENT, **changes}.items() if value is not None}
    path = folder / 'moves.yaml'
    path.write_text(yaml.safe_dump(content, sort_keys=False))
    return path


def policy_of(
    folder: Path, answer: Callable[[np.ndarray], Any], robot: PolicyRobot = ROBOT, **changes: Any
) -> tuple[Policy, FakeNetwork]:
    """
    Return a policy with changes in its file, and its network.

    Parameters
    ----------
    folder
        Where to write the file.
    answer
        The network: from an observation (n,) to the action (m,).
    robot
        The robot that the policy moves.
    **changes
        As for `write`.

    """
    network = FakeNetwork(answer)
    return Policy(read_policy_file(write(folder, **changes)), network, robot), network
