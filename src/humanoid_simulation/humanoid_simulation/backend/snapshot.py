# SPDX-License-Identifier: Apache-2.0
"""Copies of the simulation state, and its transfer to another model."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from humanoid_control.backends import Array


@dataclass(frozen=True, eq=False)
class Snapshot:
    """Copy of the generalised positions and velocities of MuJoCo at one time."""

    time_s: float
    qpos: Array
    qvel: Array


def carry_over(old: Any, old_data: Any, new: Any, new_data: Any) -> None:
    """
    Copy the states of the joints that two models have in common, by name.

    Parameters
    ----------
    old, old_data
        The model and the state to copy from.
    new, new_data
        The model and the state to copy to; derived quantities are not recomputed.

    """
    known = {old.joint(number).name for number in range(old.njnt)}
    for name in (new.joint(number).name for number in range(new.njnt)):
        if name in known:
            before, joint = old_data.joint(name), new_data.joint(name)
            joint.qpos[:], joint.qvel[:] = before.qpos, before.qvel
            joint.qacc_warmstart[:] = before.qacc_warmstart


def numbers_in(old: Any, new: Any) -> dict[int, int]:
    """
    Map the body ids of a model to those of another one, by name.

    Parameters
    ----------
    old, new
        The two MuJoCo models.

    Returns
    -------
    dict[int, int]
        New ids by the old ones, without the bodies that the new model lacks.

    """
    numbers = {new.body(number).name: number for number in range(new.nbody)}
    names = (old.body(number).name for number in range(old.nbody))
    return {number: numbers[name] for number, name in enumerate(names) if name in numbers}
