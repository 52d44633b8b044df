# SPDX-License-Identifier: Apache-2.0
"""What every controller offers to the manager that runs it."""

from __future__ import annotations

from typing import Protocol

from humanoid_control.backends import JointTargets, Observation
import numpy as np
from numpy.typing import NDArray

Mask = NDArray[np.bool_]


class Controller(Protocol):
    """Moves the joints that it claims; the manager sees to it that a joint has one owner."""

    @property
    def name(self) -> str:
        """Return what users call it."""

    @property
    def joints(self) -> tuple[str, ...]:
        """Return the joints that it moves, in the order of its targets."""

    def start(self, observation: Observation, held: JointTargets) -> None:
        """
        Start to control joints, from the targets that they have now.

        The manager calls it before `update`: for the controller of a mode when the mode is
        entered, for a `ClaimingController` when it gets joints, or has them and `waits`.

        Parameters
        ----------
        observation
            Sensor values of the present period.
        held
            Targets of all joints to go on from: those of the last period, extrapolated to now at
            their velocities; at first the measured positions, at rest.

        """

    def update(self, observation: Observation) -> JointTargets:
        """
        Compute the joint targets of the coming period. Call once per control period.

        Parameters
        ----------
        observation
            Sensor values of the present period.

        Returns
        -------
        JointTargets
            Of its n joints, in their order, each array (n,). The manager ignores those of joints
            that belong to another controller.

        """


class ClaimingController(Controller, Protocol):
    """Controller that claims joints for as long as it has commands for them."""

    @property
    def way_out(self) -> str:
        """Say what somebody else who wants its joints can do, as the end of a sentence."""

    @property
    def waits(self) -> bool:
        """Tell whether it is to be started, even if it has its joints already."""

    def wanted(self, now_s: float) -> Mask:
        """
        Compute which joints it has commands for, and so claims.

        Parameters
        ----------
        now_s
            The robot's time.

        Returns
        -------
        Mask
            Over all joints (n,).

        """

    def cancel(self) -> None:
        """Forget all commands."""
