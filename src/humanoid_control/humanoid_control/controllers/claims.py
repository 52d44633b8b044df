# SPDX-License-Identifier: Apache-2.0
"""Claims of joints: which controller owns each joint of a robot, and which may claim it."""

from __future__ import annotations

from collections.abc import Sequence

from humanoid_control.controllers.commands import CommandError, Indices
from humanoid_control.controllers.interface import ClaimingController
from humanoid_control.controllers.modes import Mode
import numpy as np
from numpy.typing import NDArray

Owners = NDArray[np.intp]
MODE = -1
"""Owner of a joint that no claimant has claimed; claimants are numbered from 0."""


class JointClaims:
    """
    Owners of the joints of one robot: its mode, and the controllers that claim joints from it.

    A joint that the mode leaves to controllers goes to the first claimant that claims it; all
    others go to the controller of the mode.

    Parameters
    ----------
    joints
        All n joints of the robot, in the order of observations and targets.
    modes
        The modes, whose controllers claim all joints in that order; the first one is entered.
    claimants
        Controllers that may claim the joints that a mode leaves to them, by decreasing priority.

    Attributes
    ----------
    mode
        The present mode.
    claimants
        The controllers that may claim joints, in the order of their priority.
    owners
        The owner of each joint (n,): the rank of a claimant, or `MODE`.

    Raises
    ------
    ValueError
        The controller of the first mode claims other joints, or in another order.

    """

    def __init__(
        self,
        joints: Sequence[str],
        modes: Sequence[Mode],
        claimants: Sequence[ClaimingController],
    ) -> None:
        self._joints = tuple(joints)
        self._modes = {mode.name: mode for mode in modes}
        self.claimants = tuple(claimants)
        self.enter(modes[0])
        self.reset()

    def enter(self, mode: Mode) -> None:
        """
        Enter a mode and cancel all claimants, which have to claim joints again.

        Parameters
        ----------
        mode
            One of the modes.

        Raises
        ------
        ValueError
            Its controller claims other joints, or in another order.

        """
        if mode.controller.joints != self._joints:
            raise ValueError(
                f"The controller of mode '{mode.name}' must claim all joints of the robot, in "
                f'the order {self._joints}, but claims {mode.controller.joints}.'
            )
        self.mode = mode
        self._claimable = np.isin(self._joints, mode.claimable)
        for claimant in self.claimants:
            claimant.cancel()

    def replace(self, mode: Mode) -> None:
        """
        Replace the mode of that name, which is to be entered again if it is the present one.

        Parameters
        ----------
        mode
            The new mode.

        """
        self._modes[mode.name] = mode

    def reset(self) -> None:
        """Give all joints to the mode."""
        self.owners: Owners = np.full(len(self._joints), MODE)

    @property
    def trouble(self) -> str:
        """Return why the mode keeps all joints at the moment; empty if there is none."""
        return self.mode.needs_all_because()

    def owner(self, joint: str) -> str:
        """
        Look up the mode or controller that currently claims a joint.

        Parameters
        ----------
        joint
            The name of a joint of the robot.

        Returns
        -------
        str
            The name of the mode or of the claimant.

        """
        return self._name_of(self.owners[self._joints.index(joint)])

    def joints_of(self, name: str) -> tuple[str, ...]:
        """
        List the joints that a mode or a claimant currently claims.

        Parameters
        ----------
        name
            The name of the mode or of the claimant.

        Returns
        -------
        tuple[str, ...]
            Names of joints, in the order of the robot; none for a mode that is not active.

        """
        return tuple(joint for joint in self._joints if self.owner(joint) == name)

    def is_claimable(self, indices: Indices) -> bool:
        """
        Check whether the mode currently leaves all the given joints to controllers.

        Parameters
        ----------
        indices
            Joint indices (m,).

        """
        return bool(self._claimable[indices].all()) and not self.trouble

    def owns(self, claimant: ClaimingController, indices: Indices) -> bool:
        """
        Check whether a claimant currently claims all the given joints.

        Parameters
        ----------
        claimant
            One of `claimants`.
        indices
            Joint indices (m,).

        """
        return bool((self.owners[indices] == self.claimants.index(claimant)).all())

    def claimed(self) -> dict[str, str]:
        """Return the joints that claimants currently claim, with the names of the claimants."""
        indices = np.flatnonzero(self.owners != MODE)
        return {self._joints[index]: self._name_of(self.owners[index]) for index in indices}

    def check(self, claimant: ClaimingController, indices: Indices) -> None:
        """
        Check that a claimant may claim joints now.

        Parameters
        ----------
        claimant
            One of `claimants`.
        indices
            Indices (m,) of the joints that it is to move.

        Raises
        ------
        CommandError
            The mode keeps one of the joints, or all of them at the moment, or a claimant of higher
            priority has claimed one.

        """
        for index in indices[~self._claimable[indices]]:
            raise CommandError(self._kept(self._joints[index]))
        if self.trouble:
            raise CommandError(
                f"The mode '{self.mode.name}' accepts no joint commands now: {self.trouble}."
            )
        rank = self.claimants.index(claimant)
        owners = self.owners[indices]
        for index in indices[(owners >= 0) & (owners < rank)]:
            owner = self.claimants[self.owners[index]]
            raise CommandError(
                f"'{self._joints[index]}' is claimed by '{owner.name}'. Leave the joint out, or "
                f'{owner.way_out}.'
            )

    def owners_at(self, now_s: float) -> Owners:
        """
        Compute the owner that each joint should have.

        Parameters
        ----------
        now_s
            The robot's time.

        Returns
        -------
        Owners
            The rank of a claimant, or `MODE`, for each of the n joints.

        """
        owners = np.full(len(self._joints), MODE)
        if self.trouble:
            return owners
        for rank in reversed(range(len(self.claimants))):
            owners[self.claimants[rank].wanted(now_s) & self._claimable] = rank
        return owners

    def _name_of(self, rank: int) -> str:
        return self.mode.name if rank == MODE else self.claimants[rank].name

    def _kept(self, joint: str) -> str:
        """Build the message about a joint that the mode keeps for itself."""
        ways = [mode.name for mode in self._modes.values() if joint in mode.claimable]
        leaves = 'only other joints' if self.mode.claimable else 'no joints'
        out = f"Leave it out, or set the mode to '{ways[0]}'." if ways else 'Leave it out.'
        return (
            f"'{joint}' is claimed by the mode '{self.mode.name}', which leaves {leaves} to "
            f'controllers. {out}'
        )
