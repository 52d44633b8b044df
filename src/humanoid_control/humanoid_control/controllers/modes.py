# SPDX-License-Identifier: Apache-2.0
"""What a robot does as a whole, and which joints other controllers may claim meanwhile."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from humanoid_control.backends import JointTargets
from humanoid_control.controllers.hold import Hold
from humanoid_control.controllers.interface import Controller, Mask


def _nothing(joints: Mask, held: JointTargets) -> None:
    """Take joints back without more ado."""


def _no_memory() -> None:
    """Have nothing to forget."""


def _always() -> bool:
    """Tell that a mode can be left at any time."""
    return True


def _no_reason() -> str:
    """Tell that nothing is wrong."""
    return ''


@dataclass(frozen=True)
class Mode:
    """
    A controller of all joints, and the joints that other controllers may claim from it.

    `take_back` is told which joints come back, (n,) true, and what they were told last. The mode
    can be left when `may_end` says so, and keeps all joints while `needs_all_because` gives a
    reason. `forget` is called when the robot has been put somewhere. The efforts of a mode that
    `supports` bear the weight of all joints wherever they are, the claimed ones too: what their
    controllers exert comes on top.
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
    Build the mode in which every joint can be claimed, and is held while nobody moves it.

    Parameters
    ----------
    joints
        All joints of the robot, in the order of its targets.

    """
    hold = Hold(joints)
    return Mode('follow', hold, tuple(joints), hold.take_back)
