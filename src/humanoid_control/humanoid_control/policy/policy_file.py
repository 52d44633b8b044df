# SPDX-License-Identifier: Apache-2.0
"""The policy file: joints, gains, what is observed, and what an action means."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math
from pathlib import Path

from humanoid_control.backends import Array
from humanoid_control.policy.checked_table import CheckedTable, PolicyError
import numpy as np
import yaml

JOINTS = 0
"""Stands for a size that is the number of joints."""
TERMS = {
    'base_ang_vel': 3,
    'projected_gravity': 3,
    'velocity_commands': 3,
    'joint_pos_rel': JOINTS,
    'joint_vel_rel': JOINTS,
    'last_action': JOINTS,
}
"""What can be observed, and the number of values."""
BY_TERM, BY_STEP = 'by_term', 'by_step'
FASTEST_HZ = 500.0
MOST_HISTORY = 100


@dataclass(frozen=True, eq=False)
class Term:
    """A part of the observation: clipped first, then scaled."""

    name: str
    size: int
    scale: Array
    """(size,)"""
    lower: Array
    """(size,)"""
    upper: Array
    """(size,)"""


@dataclass(frozen=True, eq=False)
class PolicyFile:
    """A checked policy file with m joints; each array of joints is (m,), in their order."""

    path: Path
    model: Path
    rate_hz: float
    joints: tuple[str, ...]
    """Names without a prefix."""
    default_rad: Array
    kp_nm_rad: Array | None
    """None for the gains of the robot, as in `kd_nm_s_rad`."""
    kd_nm_s_rad: Array | None
    torque_limit_nm: Array
    """Infinite without a limit."""
    action_scale_rad: Array
    action_lower: Array
    action_upper: Array
    terms: tuple[Term, ...]
    history_length: int
    history_order: str
    """`by_term`: all steps of a term before the next term; `by_step`: all terms of a step."""
    observation_clip: float

    @property
    def input_size(self) -> int:
        """Return the number of values that the network observes, with the history."""
        return self.history_length * sum(term.size for term in self.terms)

    def error(self, sentence: str) -> PolicyError:
        """
        Make an error that names the file.

        Parameters
        ----------
        sentence
            What is wrong with it.

        """
        return PolicyError(f"The policy '{self.path}' cannot be run. {sentence}")


def read_policy_file(path: Path) -> PolicyFile:
    """
    Read and check a policy file; the network beside it is not opened yet.

    Parameters
    ----------
    path
        The YAML file.

    Raises
    ------
    PolicyError
        It cannot be read, or has a mistake.

    """
    try:
        content = yaml.safe_load(path.read_text(encoding='utf-8'))
    except (OSError, UnicodeDecodeError) as error:
        raise PolicyError(
            f"The policy file '{path}' cannot be read: {error}. Give the path of a YAML file."
        ) from None
    except yaml.YAMLError as error:
        raise PolicyError(f"The policy file '{path}' is not YAML: {error}.") from None
    table = CheckedTable(path, '', content)
    table.allow(
        'model', 'rate_hz', 'joints', 'default_rad', 'kp_nm_rad', 'kd_nm_s_rad',
        'torque_limit_nm', 'action', 'observation',
    )  # fmt: skip
    joints = table.names('joints')
    action, observation = table.table('action'), table.table('observation')
    action.allow('scale_rad', 'clip')
    observation.allow('terms', 'history_length', 'history_order', 'clip')
    lower, upper = action.bounds('clip', joints)
    limit_nm = table.positive('torque_limit_nm', joints)
    return PolicyFile(
        path=path,
        model=path.parent / table.text('model'),
        rate_hz=table.number('rate_hz', 1.0, FASTEST_HZ),
        joints=joints,
        default_rad=table.vector('default_rad', joints),
        kp_nm_rad=table.positive('kp_nm_rad', joints),
        kd_nm_s_rad=table.positive('kd_nm_s_rad', joints),
        torque_limit_nm=np.full(len(joints), np.inf) if limit_nm is None else limit_nm,
        action_scale_rad=action.vector('scale_rad', joints),
        action_lower=lower,
        action_upper=upper,
        terms=_terms(observation, joints),
        history_length=observation.count('history_length', MOST_HISTORY),
        history_order=observation.choice('history_order', (BY_TERM, BY_STEP)),
        observation_clip=observation.number('clip', 0.0, math.inf, math.inf),
    )


def _terms(observation: CheckedTable, joints: Sequence[str]) -> tuple[Term, ...]:
    """Read the terms of the observation, in their order."""
    terms = []
    for each in observation.tables('terms'):
        each.allow('name', 'scale', 'clip')
        name = each.choice('name', tuple(TERMS), is_needed=True)
        among = joints if TERMS[name] == JOINTS else [str(axis) for axis in range(TERMS[name])]
        scale = each.vector('scale', among, np.ones(len(among)))
        terms.append(Term(name, len(among), scale, *each.bounds('clip', among)))
    return tuple(terms)
