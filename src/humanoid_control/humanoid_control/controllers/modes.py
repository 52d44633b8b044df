# SPDX-License-Identifier: Apache-2.0
"""Modes of a robot, and the controllers that hold the joints which no other one claims."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from humanoid_control.backends import JointTargets, Observation
from humanoid_control.controllers.interface import Controller, Mask
import numpy as np

POLICY = 'policy'
"""Name of the mode in which a trained network moves the robot."""
DOWN = 'the robot has fallen and is not back on its feet yet'
"""Why a mode that watches for falls keeps all joints."""


def _nothing(joints: Mask, held: JointTargets) -> None:
    """Accept released joints without any action."""


def _no_memory() -> None:
    """Reset nothing: the mode has no state."""


def _always() -> bool:
    """Allow a mode to be left at any time."""
    return True


def _no_reason() -> str:
    """Return no reason to keep all joints."""
    return ''


@dataclass(frozen=True)
class Mode:
    """
    A controller of all joints, and the joints that other controllers may claim from it.

    `take_back` receives the mask (n,) of released joints and the last targets of all joints. The
    mode can be left while `may_end` returns true, and keeps all joints while `needs_all_because`
    returns a reason. `forget` is called when the robot was reset or moved from outside. The
    efforts of a mode that `supports` compensate the weight of all joints in any posture, also of
    claimed ones: the efforts of their controllers are added.
    """

    name: str
    controller: Controller
    claimable: tuple[str, ...]
    take_back: Callable[[Mask, JointTargets], None] = _nothing
    may_end: Callable[[], bool] = _always
    needs_all_because: Callable[[], str] = _no_reason
    forget: Callable[[], None] = _no_memory
    supports: bool = False


def hold_mode(joints: Sequence[str]) -> Mode:
    """
    Build the mode in which every joint is held and none can be claimed.

    Parameters
    ----------
    joints
        All joints of the robot, in the order of its targets.

    """
    return Mode('hold', Hold(joints), ())


def follow_mode(joints: Sequence[str]) -> Mode:
    """
    Build the mode in which every joint can be claimed, and is held while no controller does.

    Parameters
    ----------
    joints
        All joints of the robot, in the order of its targets.

    """
    hold = Hold(joints)
    return Mode('follow', hold, tuple(joints), hold.take_back)


class Hold:
    """
    Controller that holds all joints at rest; joints that carry a load keep their efforts.

    Parameters
    ----------
    joints
        All joints of the robot, in the order of its targets.
    name
        Name of the controller, as shown to users.

    """

    def __init__(self, joints: Sequence[str], name: str = 'hold') -> None:
        self.name = name
        self.joints = tuple(joints)
        none = np.zeros(len(self.joints))
        self._targets = JointTargets(none, none, none)

    def start(self, observation: Observation, held: JointTargets) -> None:
        """
        Hold all joints at their last targets, with zero velocity and the same efforts.

        Parameters
        ----------
        observation, held
            As for `Controller.start`.

        """
        rest = np.zeros(len(self.joints))
        self._targets = JointTargets(held.positions_rad, rest, held.efforts_nm)

    def take_back(self, joints: Mask, held: JointTargets) -> None:
        """
        Hold joints that another controller has released, with zero velocity and effort.

        Parameters
        ----------
        joints
            Mask (n,) of the released joints; the others are held as before.
        held
            Targets of all n joints, at whose positions those joints are held.

        """
        before = self._targets
        self._targets = JointTargets(
            np.where(joints, held.positions_rad, before.positions_rad),
            before.velocities_rad_s,
            np.where(joints, 0.0, before.efforts_nm),
        )

    def update(self, observation: Observation) -> JointTargets:
        """
        Return the held targets, the same in every period.

        Parameters
        ----------
        observation
            Not used.

        Returns
        -------
        JointTargets
            Held targets of all n joints.

        """
        return self._targets


class Still(Hold):
    """
    Controller that, while on, holds all joints that the mode leaves to controllers.

    Parameters
    ----------
    joints
        All joints of the robot, in the order of its targets.

    Attributes
    ----------
    on
        Whether it claims the joints; initially off.

    """

    way_out = 'wait until the robot is released'

    def __init__(self, joints: Sequence[str]) -> None:
        super().__init__(joints, name='stop')
        self.on = False
        self._all = np.ones(len(self.joints), dtype=np.bool_)
        self._none = np.zeros_like(self._all)

    @property
    def waits(self) -> bool:
        """Whether a start is pending: never."""
        return False

    def wanted(self, now_s: float) -> Mask:
        """
        Claim all joints while it is switched on, else none.

        Parameters
        ----------
        now_s
            Not used.

        Returns
        -------
        Mask
            Over all joints (n,).

        """
        return self._all if self.on else self._none

    def cancel(self) -> None:
        """Stay on or off: a reset or a mode change does not release the robot from a stop."""
