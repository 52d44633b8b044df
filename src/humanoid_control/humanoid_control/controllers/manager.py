# SPDX-License-Identifier: Apache-2.0
"""Controller manager: assigns each joint to one controller, and blends targets on a change."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
import math

from humanoid_common.naming import did_you_mean
from humanoid_control.backends import JointTargets, Observation
from humanoid_control.controllers.blending import Blend
from humanoid_control.controllers.commands import CommandError, Indices
from humanoid_control.controllers.interface import ClaimingController, Mask
from humanoid_control.controllers.modes import Mode
from humanoid_control.limits import JointLimits
import numpy as np
from numpy.typing import NDArray

Owners = NDArray[np.intp]
_MODE = -1
"""Owner of a joint that no claimant has claimed; claimants are numbered from 0."""


class ControllerManager:
    """
    Manager that runs the controllers of one robot and limits their targets.

    A joint that the mode leaves to controllers goes to the first claimant that claims it; all
    others go to the controller of the mode. Every change blends from the last targets of the
    joint.

    Parameters
    ----------
    joints
        All n joints of the robot, in the order of observations and targets.
    modes
        The modes, whose controllers claim all joints in that order; the first one is entered.
    claimants
        Controllers that may claim the joints that a mode leaves to them, by decreasing priority.
    limits
        Range, velocity, effort and stiffness of the n joints.
    say
        Receives a message when a controller asks for targets that are not finite.

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
        limits: JointLimits,
        say: Callable[[str], None] = lambda sentence: None,
    ) -> None:
        self.joints = tuple(joints)
        self._modes = {mode.name: mode for mode in modes}
        self._claimants = tuple(claimants)
        self._limits = limits
        self._say = say
        self._blend = Blend(len(self.joints))
        self._enter(modes[0])
        self.reset()

    @property
    def mode(self) -> str:
        """Return the name of the mode."""
        return self._mode.name

    @property
    def is_leaving(self) -> bool:
        """Whether a mode switch is pending until the current mode can be left."""
        return self._next is not self._mode

    @property
    def trouble(self) -> str:
        """Return why the mode keeps all joints at the moment; empty if there is none."""
        return self._mode.needs_all_because()

    @property
    def modes(self) -> tuple[str, ...]:
        """Return the names of all modes."""
        return tuple(self._modes)

    @property
    def mode_types(self) -> dict[str, str]:
        """Return the types of the controllers of all modes, by the names of the modes."""
        return {
            name: f'humanoid_control/{type(mode.controller).__name__}'
            for name, mode in self._modes.items()
        }

    def switch(self, mode: str) -> None:
        """
        Request a mode switch.

        It takes place in the first `update` in which the current mode can be left, and blends the
        targets. The name of the current mode withdraws a pending request.

        Parameters
        ----------
        mode
            The name of the mode to switch to.

        Raises
        ------
        CommandError
            There is no such mode.

        """
        if mode not in self._modes:
            known = ', '.join(self._modes)
            raise CommandError(
                f"There is no mode '{mode}'. {did_you_mean(mode, self._modes)} It has: {known}."
            )
        self._next = self._modes[mode]

    def reset(self) -> None:
        """Reset all controllers; restart from the joint positions of the next observation."""
        for claimant in self._claimants:
            claimant.cancel()
        for mode in self._modes.values():
            mode.forget()
        self._last: JointTargets | None = None
        self._last_s = 0.0
        self._owners: Owners = np.full(len(self.joints), _MODE)
        self._active: dict[int, Mask] = {}
        self._entered = True

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
        return self._name_of(self._owners[self.joints.index(joint)])

    @property
    def claimants(self) -> tuple[ClaimingController, ...]:
        """Return the controllers that may claim joints, in the order of their priority."""
        return self._claimants

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
        return tuple(joint for joint in self.joints if self.owner(joint) == name)

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
        return bool((self._owners[indices] == self._claimants.index(claimant)).all())

    def claimed(self) -> dict[str, str]:
        """Return the joints that claimants currently claim, with the names of the claimants."""
        indices = np.flatnonzero(self._owners != _MODE)
        return {self.joints[index]: self._name_of(self._owners[index]) for index in indices}

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
            raise CommandError(self._kept(self.joints[index]))
        if self.trouble:
            raise CommandError(
                f"The mode '{self.mode}' accepts no joint commands now: {self.trouble}."
            )
        rank = self._claimants.index(claimant)
        owners = self._owners[indices]
        for index in indices[(owners >= 0) & (owners < rank)]:
            owner = self._claimants[self._owners[index]]
            raise CommandError(
                f"'{self.joints[index]}' is claimed by '{owner.name}'. Leave the joint out, or "
                f'{owner.way_out}.'
            )

    def update(self, observation: Observation) -> JointTargets:
        """
        Compute the targets of all joints for the coming period. Call once per control period.

        Switches the mode if requested and possible, assigns joints to the claimants that claim
        them, and blends and limits the targets.

        Parameters
        ----------
        observation
            Sensor values of the current period.

        Returns
        -------
        JointTargets
            Targets of all n joints, within their position, velocity and effort limits.

        """
        now_s = observation.time_s
        if self.is_leaving and self._mode.may_end():
            self._enter(self._next)
        last = self._last or _at_rest(observation)
        elapsed_s = now_s - self._last_s if self._last else 0.0
        held = _continued(last, elapsed_s)
        changed = self._change_owners(observation, held)
        wished = self._wished(observation, held)
        if changed is not None:
            self._blend.begin(changed, now_s, held, wished)
        wished = self._blend.blended(now_s, wished)
        self._last = self._limits.limited(wished, last.positions_rad, elapsed_s)
        self._last_s = now_s
        return self._last

    def _enter(self, mode: Mode) -> None:
        """Enter a mode and cancel all claimants, which have to claim joints again."""
        if mode.controller.joints != self.joints:
            raise ValueError(
                f"The controller of mode '{mode.name}' must claim all joints of the robot, in "
                f'the order {self.joints}, but claims {mode.controller.joints}.'
            )
        self._mode, self._next, self._entered = mode, mode, True
        self._claimable = np.isin(self.joints, mode.claimable)
        for claimant in self._claimants:
            claimant.cancel()

    def _change_owners(self, observation: Observation, held: JointTargets) -> Mask | None:
        """Start the controllers that are assigned joints; return those joints, None for none."""
        owners = self._owners_at(observation.time_s)
        news = self._news(owners)
        if not (self._entered or news.any()):
            return None
        self._start(owners, news, observation, held)
        self._owners, self._entered = owners, False
        self._active = {
            rank: owners == rank for rank in range(len(self._claimants)) if (owners == rank).any()
        }
        return news

    def _owners_at(self, now_s: float) -> Owners:
        """Compute the owner of each joint, (n,): the rank of a claimant, or _MODE."""
        owners = np.full(len(self.joints), _MODE)
        if self.trouble:
            return owners
        for rank in reversed(range(len(self._claimants))):
            owners[self._claimants[rank].wanted(now_s) & self._claimable] = rank
        return owners

    def _news(self, owners: Owners) -> Mask:
        """Compute the mask (n,) of joints whose controller changes or `waits`."""
        if self._entered:
            return np.ones_like(self._claimable)
        news: Mask = owners != self._owners
        for rank, claimant in enumerate(self._claimants):
            if claimant.waits:
                news |= owners == rank
        return news

    def _start(
        self, owners: Owners, news: Mask, observation: Observation, held: JointTargets
    ) -> None:
        """Notify controllers of the joints that they were assigned."""
        returned = news & (owners == _MODE)
        if self._entered:
            self._mode.controller.start(observation, held)
        elif returned.any():
            self._mode.take_back(returned, held)
        if self._mode.supports:
            held = replace(held, efforts_nm=np.zeros(len(self.joints)))
        for rank, claimant in enumerate(self._claimants):
            if (news & (owners == rank)).any():
                claimant.start(observation, held)

    def _wished(self, observation: Observation, held: JointTargets) -> JointTargets:
        """Merge the targets of the mode and the claimants; non-finite ones are replaced."""
        own = wished = self._mode.controller.update(observation)
        for rank, joints in self._active.items():
            wished = _merged(wished, self._claimants[rank].update(observation), joints)
        if self._active and self._mode.supports:
            claimed = self._owners != _MODE
            wished = replace(wished, efforts_nm=wished.efforts_nm + claimed * own.efforts_nm)
        return wished if _is_finite(wished) else self._repaired(wished, held)

    def _repaired(self, wished: JointTargets, held: JointTargets) -> JointTargets:
        """Hold the joints whose targets are not finite, and report the controller at fault."""
        sound = np.isfinite(wished.positions_rad + wished.velocities_rad_s + wished.efforts_nm)
        index = int(np.argmin(sound))
        self._say(
            f"'{self._name_of(self._owners[index])}' commands '{self.joints[index]}' "
            'to a target that is not finite: the joint is held.'
        )
        rest = JointTargets(held.positions_rad, *np.zeros((2, len(self.joints))))
        return _merged(rest, wished, sound)

    def _name_of(self, rank: int) -> str:
        return self.mode if rank == _MODE else self._claimants[rank].name

    def _kept(self, joint: str) -> str:
        """Build the message about a joint that the mode keeps for itself."""
        ways = [mode.name for mode in self._modes.values() if joint in mode.claimable]
        leaves = 'only other joints' if self._mode.claimable else 'no joints'
        out = f"Leave it out, or set the mode to '{ways[0]}'." if ways else 'Leave it out.'
        return (
            f"'{joint}' is claimed by the mode '{self.mode}', which leaves {leaves} to "
            f'controllers. {out}'
        )


def _at_rest(observation: Observation) -> JointTargets:
    """Build targets that hold the joints at their measured positions."""
    return JointTargets(observation.positions_rad, *np.zeros((2, len(observation.positions_rad))))


def _continued(targets: JointTargets, elapsed_s: float) -> JointTargets:
    """Extrapolate the target positions at their velocities."""
    positions_rad = targets.positions_rad + elapsed_s * targets.velocities_rad_s
    return replace(targets, positions_rad=positions_rad)


def _merged(targets: JointTargets, others: JointTargets, chosen: Mask) -> JointTargets:
    """Replace the targets of the chosen joints with others."""
    return JointTargets(
        np.where(chosen, others.positions_rad, targets.positions_rad),
        np.where(chosen, others.velocities_rad_s, targets.velocities_rad_s),
        np.where(chosen, others.efforts_nm, targets.efforts_nm),
    )


def _is_finite(targets: JointTargets) -> bool:
    """Check whether all targets are finite; a sum is the cheapest test."""
    total = targets.positions_rad.sum() + targets.velocities_rad_s.sum()
    return math.isfinite(total + targets.efforts_nm.sum())
