# SPDX-License-Identifier: Apache-2.0
"""External wrenches of limited duration, and the forces of contacts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from humanoid_control.backends import Array
from humanoid_simulation.errors import SimulationError
import mujoco
import numpy as np

MOST = 100
"""Maximum number of wrenches at a time: each one costs time in every period."""


@dataclass(frozen=True, eq=False)
class Wrench:
    """A force and a torque (3,) in world axes, at a point (3,) of a body in body axes."""

    body: int
    force_n: Array
    torque_nm: Array
    point_m: Array
    duration_s: float

    def __post_init__(self) -> None:
        """Check that the vectors are finite, and the duration finite and positive."""
        for kind in ('force_n', 'torque_nm', 'point_m'):
            array = getattr(self, kind)
            if array.shape != (3,) or not np.isfinite(array).all():
                raise SimulationError(
                    f'A wrench needs a {kind} of three finite numbers, but it is {array}.'
                )
        if not 0.0 < self.duration_s < np.inf:
            raise SimulationError(
                f'A wrench cannot last {self.duration_s:g} s. Give a duration above zero.'
            )


class Wrenches:
    """
    External wrenches that act on the bodies of a world for a limited time.

    A wrench that ends within a period is scaled down over all of it, to get the impulse right.

    Parameters
    ----------
    data
        The MuJoCo state, whose `xfrc_applied` is set.

    """

    def __init__(self, data: Any) -> None:
        self._data = data
        self._acting: list[tuple[Wrench, float]] = []

    def enter(self, data: Any, numbers: Mapping[int, int]) -> None:
        """
        Switch to another model; wrenches on bodies that it lacks end.

        Parameters
        ----------
        data
            The state of the new MuJoCo model.
        numbers
            New ids of the bodies, by the old ones.

        """
        self._data = data
        self._acting = [
            (replace(wrench, body=numbers[wrench.body]), left_s)
            for wrench, left_s in self._acting
            if wrench.body in numbers
        ]

    def add(self, wrench: Wrench, *, always: bool = False) -> None:
        """
        Apply a wrench from the next period on.

        Parameters
        ----------
        wrench
            The wrench; it adds to others on the same body.
        always
            Whether it is exempt from the limit of `MOST` wrenches, as that of a hoist is.

        Raises
        ------
        SimulationError
            `MOST` wrenches act already.

        """
        if len(self._acting) >= MOST and not always:
            raise SimulationError(
                f'{MOST} wrenches are already active, which is the maximum. Wait until they end, '
                'or reset the simulation.'
            )
        self._acting.append((wrench, wrench.duration_s))

    def clear(self) -> None:
        """End all wrenches."""
        self._acting = []
        self._data.xfrc_applied[:] = 0.0

    def act(self, period_s: float) -> None:
        """
        Set the external forces (`xfrc_applied`) for the coming period.

        Parameters
        ----------
        period_s
            Length of a control period.

        """
        if not self._acting:
            return
        self._data.xfrc_applied[:] = 0.0
        for wrench, left_s in self._acting:
            self._apply(wrench, min(1.0, left_s / period_s))
        # Ended wrenches stay for one more period, in which their forces are set to zero.
        self._acting = [
            (wrench, left_s - period_s) for wrench, left_s in self._acting if left_s > 0
        ]

    def _apply(self, wrench: Wrench, part: float) -> None:
        """Add a wrench, scaled by `part`, to those on its body, about the centre of mass."""
        if part <= 0.0:
            return
        data, body = self._data, wrench.body
        point_m = data.xpos[body] + data.xmat[body].reshape(3, 3) @ wrench.point_m
        turning = np.cross(point_m - data.xipos[body], wrench.force_n)
        data.xfrc_applied[body, :3] += part * wrench.force_n
        data.xfrc_applied[body, 3:] += part * (wrench.torque_nm + turning)


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
