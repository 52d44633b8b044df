# SPDX-License-Identifier: Apache-2.0
"""The state of a world, copied for those who look at it, or carried over into another one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from humanoid_control.backends import Array


@dataclass(frozen=True, eq=False)
class Snapshot:
    """Positions and velocities as MuJoCo counts them, at a moment."""

    time_s: float
    qpos: Array
    qvel: Array


def carry_over(old: Any, old_data: Any, new: Any, new_data: Any) -> None:
    """
    Set the joints that two models have in common, by name, to positions and velocities of one.

    Parameters
    ----------
    old, old_data
        The model and the state that is taken.
    new, new_data
        The model and the state that is set; what follows from it is left to be computed.

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
        New ids by the old ones; bodies that the new model does not have are left out.

    """
    numbers = {new.body(number).name: number for number in range(new.nbody)}
    names = (old.body(number).name for number in range(old.nbody))
    return {number: numbers[name] for number, name in enumerate(names) if name in numbers}
