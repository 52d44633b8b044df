# SPDX-License-Identifier: Apache-2.0
"""The policy file: joints, gains, what is observed, and what an action means."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
import math
from pathlib import Path
from typing import Any

from humanoid_common.errors import UserError
from humanoid_common.naming import did_you_mean, shortened
from humanoid_common.tables import is_number, load_table, Table
from humanoid_control.backends import Array
import numpy as np

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


class PolicyError(UserError):
    """A policy cannot be run; the message says why, and what to do."""


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
    TableError
        It cannot be read, or has a mistake.

    """
    table = load_table(path)
    table.allow(
        'model', 'rate_hz', 'joints', 'default_rad', 'kp_nm_rad', 'kd_nm_s_rad',
        'torque_limit_nm', 'action', 'observation',
    )  # fmt: skip
    joints = _names(table, 'joints')
    action, observation = table.table('action'), table.table('observation')
    action.allow('scale_rad', 'clip')
    observation.allow('terms', 'history_length', 'history_order', 'clip')
    lower, upper = _bounds(action, 'clip', joints)
    clip = math.inf
    if observation.has('clip'):
        clip = observation.number('clip', None, (0.0, math.inf))
    limit_nm = _positive(table, 'torque_limit_nm', joints)
    return PolicyFile(
        path=path,
        model=path.parent / table.text('model'),
        rate_hz=table.number('rate_hz', None, (1.0, FASTEST_HZ)),
        joints=joints,
        default_rad=_finite(table, 'default_rad', joints),
        kp_nm_rad=_positive(table, 'kp_nm_rad', joints),
        kd_nm_s_rad=_positive(table, 'kd_nm_s_rad', joints),
        torque_limit_nm=np.full(len(joints), np.inf) if limit_nm is None else limit_nm,
        action_scale_rad=_finite(action, 'scale_rad', joints),
        action_lower=lower,
        action_upper=upper,
        terms=_terms(observation, joints),
        history_length=observation.integer('history_length', 1, (1, MOST_HISTORY)),
        history_order=observation.choice('history_order', (BY_TERM, BY_STEP), BY_TERM),
        observation_clip=clip,
    )


def _terms(observation: Table, joints: Sequence[str]) -> tuple[Term, ...]:
    """Read the terms of the observation, in their order."""
    terms = []
    for each in observation.tables('terms'):
        each.allow('name', 'scale', 'clip')
        name = each.choice('name', tuple(TERMS))
        among = joints if TERMS[name] == JOINTS else [str(axis) for axis in range(TERMS[name])]
        scale = _finite(each, 'scale', among) if each.has('scale') else np.ones(len(among))
        terms.append(Term(name, len(among), scale, *_bounds(each, 'clip', among)))
    if not terms:
        raise observation.at('terms').error('Nothing is observed. Give at least one term.')
    return tuple(terms)


def _names(table: Table, name: str) -> tuple[str, ...]:
    """Read a list of different names."""
    names = table.value(name)
    if not isinstance(names, list) or not names:
        raise table.at(name).wrong('a list of names', names)
    for each in names:
        if not isinstance(each, str) or names.count(each) > 1:
            raise table.at(name).wrong('a list of names, each once', each)
    return tuple(names)


def _finite(table: Table, name: str, among: Sequence[str]) -> Array:
    """Read a finite number for each joint or axis."""
    values = _each(table, name, among, table.value(name))
    if not np.isfinite(values).all():
        raise table.at(name).wrong('finite', table.value(name))
    return values


def _positive(table: Table, name: str, among: Sequence[str]) -> Array | None:
    """Read a number of zero or more for each joint or axis; None if the file gives none."""
    if not table.has(name):
        return None
    values = _finite(table, name, among)
    if (values < 0.0).any():
        raise table.at(name).wrong('zero or more', float(values.min()))
    return values


def _bounds(table: Table, name: str, among: Sequence[str]) -> tuple[Array, Array]:
    """Read the least and the largest value for each joint or axis; infinite if not given."""
    pair = table.value(name) if table.has(name) else [-math.inf, math.inf]
    if not isinstance(pair, list) or len(pair) != 2:
        raise table.at(name).wrong('a list of two bounds', pair)
    lower, upper = (_each(table, name, among, each) for each in pair)
    if (lower > upper).any():
        raise table.at(name).wrong('two bounds, the lower one first', pair)
    return lower, upper


def _each(table: Table, name: str, among: Sequence[str], value: Any) -> Array:
    """Spread a value: one number is for all, a list has their order, a table has their names."""
    place = table.at(name)
    if value is None:
        raise table.place.missing(name)
    if isinstance(value, Mapping):
        for key in value:
            if key not in among:
                hint = did_you_mean(str(key), among) or f'Valid names: {", ".join(among)}.'
                raise place.error(f"{place.name} names an unknown '{shortened(str(key))}'. {hint}")
        value = [value.get(key) for key in among]
    values = value if isinstance(value, list) else [value] * len(among)
    if len(values) != len(among) or not all(map(is_number, values)):
        raise place.wrong(f'a number, or {len(among)} of them', value)
    return np.array(values, dtype=np.float64)
