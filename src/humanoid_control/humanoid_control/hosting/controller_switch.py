# SPDX-License-Identifier: Apache-2.0
"""Controllers as ros2_control lists them, and the switch that activates and deactivates them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

from humanoid_common.naming import did_you_mean, shortened
from humanoid_control.controllers import GoalController
from humanoid_control.controllers.interface import DEACTIVATED
from humanoid_control.hosting.robot_control import RobotControl

BROADCASTER = 'joint_state_broadcaster'
BROADCASTER_CLASS = f'{BROADCASTER}/JointStateBroadcaster'
"""What publishes `joint_states` in ros2_control: here the node, as long as it runs."""
ACTIVE, INACTIVE = 'active', 'inactive'
QUANTITIES = ('position', 'velocity', 'effort')
"""Command and state interfaces of a joint."""


class Strictness(IntEnum):
    """Strictness of a controller switch, with the values of controller_manager_msgs."""

    BEST_EFFORT = 1
    STRICT = 2
    AUTO = 3
    FORCE_AUTO = 4


@dataclass(frozen=True)
class ControllerInfo:
    """A controller, with the joints that it claims now, that it requires, and that it reads."""

    name: str
    kind: str
    is_active: bool
    claimed: tuple[str, ...]
    required: tuple[str, ...]
    read: tuple[str, ...]

    @property
    def state(self) -> str:
        """Return the name of its state."""
        return ACTIVE if self.is_active else INACTIVE


def interfaces_of(joints: Sequence[str]) -> list[str]:
    """
    List the ros2_control interfaces of joints; command and state interfaces are the same.

    Parameters
    ----------
    joints
        Names of joints.

    Returns
    -------
    list of str
        Three per joint: `joint/position`, `joint/velocity` and `joint/effort`.

    """
    return [f'{joint}/{quantity}' for joint in joints for quantity in QUANTITIES]


def controllers_of(control: RobotControl) -> list[ControllerInfo]:
    """
    List the controllers of a robot, with their states and the joints that they claim.

    Each joint is claimed by exactly one of them at any moment.

    Parameters
    ----------
    control
        The control of the robot.

    Returns
    -------
    list of ControllerInfo
        First those that accept goals, then the modes, of which one is active, then those that move
        joints as commanded on a topic, and last the one that publishes the states of all joints.

    """
    manager, claims = control.manager, control.manager.claims
    claimable = any(
        claims.is_claimable(controller.indices) for controller in control.goals.by_name.values()
    )
    limbs = [
        ControllerInfo(
            name,
            controller.kind,
            controller.is_active and claims.is_claimable(controller.indices),
            claims.joints_of(name),
            controller.own,
            controller.own,
        )
        for name, controller in control.goals.by_name.items()
    ]
    modes = [
        ControllerInfo(
            name,
            kind,
            name == manager.mode,
            claims.joints_of(name),
            manager.joints,
            manager.joints,
        )
        for name, kind in manager.mode_types.items()
    ]
    others = [
        ControllerInfo(
            claimant.name,
            f'humanoid_control/{type(claimant).__name__}',
            control.must_hold if claimant is control.still else claimable,
            claims.joints_of(claimant.name),
            (),
            (),
        )
        for claimant in claims.claimants
        if not isinstance(claimant, GoalController)
    ]
    broadcaster = ControllerInfo(BROADCASTER, BROADCASTER_CLASS, True, (), (), manager.joints)
    return [*limbs, *modes, *others, broadcaster]


def switch(
    control: RobotControl, activate: Sequence[str], deactivate: Sequence[str], strictness: int
) -> tuple[bool, str]:
    """
    Activate and deactivate controllers that accept goals.

    Parameters
    ----------
    control
        The control of the robot.
    activate, deactivate
        Names of controllers. One that is in both is restarted: it releases its joints.
    strictness
        With BEST_EFFORT, whatever can be switched is switched, and a controller may be in the
        wanted state already. All others switch everything or nothing: without controller chains,
        AUTO and FORCE_AUTO have nothing to resolve.

    Returns
    -------
    tuple[bool, str]
        Whether the switch succeeded, and a message about what did not.

    """
    if strictness not in (0, *Strictness):
        return False, f'Unknown strictness {strictness}. Give BEST_EFFORT (1) or STRICT (2).'
    is_strict = strictness not in (0, Strictness.BEST_EFFORT)
    restarted = set(activate) & set(deactivate)
    faults = {
        **{name: _fault(control, name, False, is_strict) for name in deactivate},
        **{
            name: _fault(control, name, True, is_strict and name not in restarted)
            for name in activate
        },
    }
    message = ' '.join(fault for fault in faults.values() if fault)
    if is_strict and message:
        return False, f'{message} Nothing was switched.'
    for name in deactivate:
        if not faults[name]:
            _set(control.goals.by_name[name], False)
    for name in activate:
        if not faults[name]:
            _set(control.goals.by_name[name], True)
    lists = [names for names in (activate, deactivate) if names]
    return all(any(not faults[name] for name in names) for names in lists), message


def _set(controller: GoalController[Any, Any], active: bool) -> None:
    """Activate or deactivate a controller; an inactive one claims no joints."""
    if not active:
        controller.release(DEACTIVATED)
    controller.is_active = active


def _fault(control: RobotControl, name: str, active: bool, is_strict: bool) -> str:
    """Return the reason why a controller cannot be switched; empty if it can."""
    controller = control.goals.by_name.get(name)
    if controller is None:
        return not_switched(control, name)
    if active and not control.manager.claims.is_claimable(controller.indices):
        reason = control.manager.claims.trouble
        keeps = (
            f'accepts no commands now: {reason}'
            if reason
            else 'lets no controller claim its joints'
        )
        return f"'{name}' cannot be active: the mode '{control.manager.mode}' {keeps}."
    if is_strict and controller.is_active == active:
        return f"'{name}' is already {ACTIVE if active else INACTIVE}."
    return ''


def not_switched(control: RobotControl, name: str) -> str:
    """
    Build the message about a name that is not a controller that accepts goals.

    Parameters
    ----------
    control
        The control of the robot.
    name
        The name.

    """
    if name in control.manager.modes:
        return (
            f"'{name}' is a mode of the robot. Set the parameter 'mode' of the node that runs the "
            'robot.'
        )
    known = [each.name for each in controllers_of(control)]
    if name == BROADCASTER:
        return f"'{name}' is always active: the robot publishes joint_states as long as it runs."
    if name in known:
        return f"'{name}' is always active and listens to its topic."
    advice = did_you_mean(name, known) or f'The controllers are: {", ".join(known)}.'
    return f"There is no controller '{shortened(name)}'. {advice}"
