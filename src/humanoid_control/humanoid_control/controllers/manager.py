# SPDX-License-Identifier: Apache-2.0
"""Controller manager: runs the controllers of a robot, and blends targets on a change."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
import math

from humanoid_common.naming import did_you_mean
from humanoid_control.backends import Array, JointLimits, JointTargets, Observation
from humanoid_control.controllers.claims import JointClaims, MODE, Owners
from humanoid_control.controllers.commands import CommandError
from humanoid_control.controllers.interface import ClaimingController, Mask
from humanoid_control.controllers.modes import Mode
import numpy as np

BLEND_S = 0.5


class ControllerManager:
    """
    Manager that runs the controllers of one robot and limits their targets.

    `JointClaims` assigns each joint to one of them. Every change blends from the last targets of
    the joint.

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

    Attributes
    ----------
    claims
        Which controller owns each joint.

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
        self.claims = JointClaims(joints, modes, claimants)
        self._limits = limits
        self._say = say
        self._blend = Blend(len(self.joints))
        self._next = modes[0]
        self.reset()

    @property
    def mode(self) -> str:
        """Return the name of the mode."""
        return self.claims.mode.name

    @property
    def is_leaving(self) -> bool:
        """Whether a mode switch is pending until the current mode can be left."""
        return self._next is not self.claims.mode

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

    def replace(self, mode: Mode) -> None:
        """
        Replace the mode of that name; the robot enters it again if it is, or was to be, in it.

        Parameters
        ----------
        mode
            The new mode, whose controller has the same joints.

        """
        self._modes[mode.name] = mode
        self.claims.replace(mode)
        if self._next.name == mode.name:
            self._next = mode

    def reset(self) -> None:
        """Reset all controllers; restart from the joint positions of the next observation."""
        for claimant in self.claims.claimants:
            claimant.cancel()
        for mode in self._modes.values():
            mode.forget()
        self._last: JointTargets | None = None
        self._last_s = 0.0
        self.claims.reset()
        self._active: dict[int, Mask] = {}
        self._entered = True

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
        if self.is_leaving and self.claims.mode.may_end():
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
        """Enter a mode; the claimants have to claim joints again."""
        self.claims.enter(mode)
        self._next, self._entered = mode, True

    def _change_owners(self, observation: Observation, held: JointTargets) -> Mask | None:
        """Start the controllers that are assigned joints; return those joints, None for none."""
        owners = self.claims.owners_at(observation.time_s)
        news = self._news(owners)
        if not (self._entered or news.any()):
            return None
        self._start(owners, news, observation, held)
        self.claims.owners, self._entered = owners, False
        ranks = range(len(self.claims.claimants))
        self._active = {rank: owners == rank for rank in ranks if (owners == rank).any()}
        return news

    def _news(self, owners: Owners) -> Mask:
        """Compute the mask (n,) of joints whose controller changes or `waits`."""
        if self._entered:
            return np.ones(len(self.joints), dtype=np.bool_)
        news: Mask = owners != self.claims.owners
        for rank, claimant in enumerate(self.claims.claimants):
            if claimant.waits:
                news |= owners == rank
        return news

    def _start(
        self, owners: Owners, news: Mask, observation: Observation, held: JointTargets
    ) -> None:
        """Notify controllers of the joints that they were assigned."""
        returned = news & (owners == MODE)
        if self._entered:
            self.claims.mode.controller.start(observation, held)
        elif returned.any():
            self.claims.mode.take_back(returned, held)
        if self.claims.mode.supports:
            held = replace(held, efforts_nm=np.zeros(len(self.joints)))
        for rank, claimant in enumerate(self.claims.claimants):
            if (news & (owners == rank)).any():
                claimant.start(observation, held)

    def _wished(self, observation: Observation, held: JointTargets) -> JointTargets:
        """Merge the targets of the mode and the claimants; non-finite ones are replaced."""
        own = wished = self.claims.mode.controller.update(observation)
        for rank, joints in self._active.items():
            wished = _merged(wished, self.claims.claimants[rank].update(observation), joints)
        if self._active and self.claims.mode.supports:
            claimed = self.claims.owners != MODE
            wished = replace(wished, efforts_nm=wished.efforts_nm + claimed * own.efforts_nm)
        return wished if _is_finite(wished) else self._repaired(wished, held)

    def _repaired(self, wished: JointTargets, held: JointTargets) -> JointTargets:
        """Hold the joints whose targets are not finite, and report the controller at fault."""
        sound = np.isfinite(wished.positions_rad + wished.velocities_rad_s + wished.efforts_nm)
        index = int(np.argmin(sound))
        joint = self.joints[index]
        self._say(
            f"'{self.claims.owner(joint)}' commands '{joint}' "
            'to a target that is not finite: the joint is held.'
        )
        rest = JointTargets(held.positions_rad, *np.zeros((2, len(self.joints))))
        return _merged(rest, wished, sound)


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


class Blend:
    """
    Offset that blends the targets of joints from those of their old controller to the new ones.

    It starts at the difference in position and velocity and decays to zero along the minimum-jerk
    polynomial (Flash and Hogan, 1985).

    Parameters
    ----------
    joints
        Number of joints of the robot, n.
    duration_s
        Time from a change of controller until the offset is zero.

    """

    def __init__(self, joints: int, duration_s: float = BLEND_S) -> None:
        self._duration_s = duration_s
        self._since_s = np.full(joints, -np.inf)
        self._until_s = -np.inf
        self._offset_rad, self._speed_rad_s, self._effort_nm = np.zeros((3, joints))

    def begin(self, joints: Mask, now_s: float, last: JointTargets, new: JointTargets) -> None:
        """
        Start blending joints from their old targets to those of their new controller.

        Parameters
        ----------
        joints
            Mask (n,) of the joints whose controller changes.
        now_s
            The robot's time.
        last, new
            Targets of all n joints at this moment: those of the old and those of the new
            controllers.

        """
        self._since_s[joints] = now_s
        self._until_s = now_s + self._duration_s
        self._offset_rad[joints] = (last.positions_rad - new.positions_rad)[joints]
        self._speed_rad_s[joints] = (last.velocities_rad_s - new.velocities_rad_s)[joints]
        self._effort_nm[joints] = (last.efforts_nm - new.efforts_nm)[joints]

    def blended(self, now_s: float, new: JointTargets) -> JointTargets:
        """
        Add the remaining offset to the current targets.

        Parameters
        ----------
        now_s
            The robot's time.
        new
            Targets of all n joints from their current controllers.

        Returns
        -------
        JointTargets
            Blended targets of all n joints; `new` itself when no blend is under way.

        """
        if now_s >= self._until_s:
            return new
        passed = np.minimum((now_s - self._since_s) / self._duration_s, 1.0)
        offset_rad, speed_rad_s, share = self._left(passed)
        return JointTargets(
            new.positions_rad + offset_rad,
            new.velocities_rad_s + speed_rad_s,
            new.efforts_nm + share * self._effort_nm,
        )

    def _left(self, passed: Array) -> tuple[Array, Array, Array]:
        """Compute the offset, its derivative and its weight at a fraction of the blend time."""
        left = 1.0 - passed
        share = left**3 * (1.0 + 3.0 * passed + 6.0 * passed**2)
        share_rate = -30.0 * (passed * left) ** 2 / self._duration_s
        slope = passed * left**3 * (1.0 + 3.0 * passed)
        slope_rate = left**2 * (1.0 + 2.0 * passed - 15.0 * passed**2)
        offset_rad = share * self._offset_rad + slope * self._duration_s * self._speed_rad_s
        speed_rad_s = share_rate * self._offset_rad + slope_rate * self._speed_rad_s
        return offset_rad, speed_rad_s, share
