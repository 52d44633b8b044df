# SPDX-License-Identifier: Apache-2.0
"""Contact points between bodies."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from humanoid_control.backends import Array
import mujoco
import numpy as np


@dataclass(frozen=True, eq=False)
class Contact:
    """
    A contact point between two bodies, in world axes.

    The normal (3,) points from the first body to the second; the force (3,) is the one that the
    first exerts on the second.
    """

    body1: str
    body2: str
    position_m: Array
    normal: Array
    force_n: Array


def contacts_in(model: Any, data: Any, names: Sequence[str]) -> Iterator[Contact]:
    """
    Iterate over the contacts of the last physics step.

    Parameters
    ----------
    model, data
        The MuJoCo model, and its state.
    names
        Names of all bodies, in the order of the model.

    Yields
    ------
    Contact
        One for each contact point.

    """
    wrench = np.empty(6)
    bodies = model.geom_bodyid
    for number in range(data.ncon):
        contact = data.contact[number]
        mujoco.mj_contactForce(model, data, number, wrench)
        axes = contact.frame.reshape(3, 3)
        yield Contact(
            names[bodies[contact.geom1]],
            names[bodies[contact.geom2]],
            contact.pos.copy(),
            axes[0].copy(),
            wrench[:3] @ axes,
        )
