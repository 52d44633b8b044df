# SPDX-License-Identifier: Apache-2.0
"""Modes of a robot, and the joints that other controllers may claim in each."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from humanoid_control.backends import JointTargets
from humanoid_control.controllers.hold import Hold
from humanoid_control.controllers.interface import Controller, Mask


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
