# SPDX-License-Identifier: Apache-2.0
"""Interfaces of the controllers of a robot."""

from __future__ import annotations

from typing import Protocol

from humanoid_control.backends import JointTargets, Observation
import numpy as np
from numpy.typing import NDArray

Mask = NDArray[np.bool_]


class Controller(Protocol):
    """Controller of joints; the manager assigns each joint to exactly one controller."""

    @property
    def name(self) -> str:
        """Return the name shown to users."""

    @property
    def joints(self) -> tuple[str, ...]:
        """Return the joints that it moves, in the order of its targets."""

    def start(self, observation: Observation, held: JointTargets) -> None:
        """
        Start controlling joints from their current targets.

        The manager calls it before `update`: for the controller of a mode when the mode is
        entered, for a `ClaimingController` when it is assigned joints, or has some and `waits`.

        Parameters
        ----------
        observation
            Sensor values of the current period.
        held
            Targets of all joints to continue from: those of the last period, extrapolated to now
            at their velocities; initially the measured positions, at rest.

        """

    def update(self, observation: Observation) -> JointTargets:
        """
        Compute the joint targets for the coming period. Call once per control period.

        Parameters
        ----------
        observation
            Sensor values of the current period.

        Returns
        -------
        JointTargets
            Targets of its n joints, in their order, each array (n,). The manager ignores those of
            joints that belong to another controller.

        """


class ClaimingController(Controller, Protocol):
    """Controller that claims joints for as long as it has commands for them."""

    @property
    def way_out(self) -> str:
        """Return a way to free its joints for another controller, to end an error message."""

    @property
    def waits(self) -> bool:
        """Whether `start` is to be called, even if it has its joints already."""

    def wanted(self, now_s: float) -> Mask:
        """
        Compute the mask of joints that it has commands for and therefore claims.

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
        """Drop all commands."""
