# SPDX-License-Identifier: Apache-2.0
"""Services of a controller manager: `ros2 control` lists and switches controllers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

from controller_manager_msgs.msg import ControllerState, HardwareComponentState, HardwareInterface
from controller_manager_msgs.srv import (
    CleanupController,
    ConfigureController,
    ListControllers,
    ListControllerTypes,
    ListHardwareComponents,
    ListHardwareInterfaces,
    LoadController,
    ReloadControllerLibraries,
    SetHardwareComponentState,
    SwitchController,
    UnloadController,
)
from humanoid_common.naming import did_you_mean, shortened
from humanoid_control.controllers import GoalController
from humanoid_control.controllers.interface import DEACTIVATED
from humanoid_control.hosting.robot_control import RobotControl
from humanoid_control.hosting.topics.filling import topic
from lifecycle_msgs.msg import State
from rclpy.node import Node

WRENCH = (*(f'force.{axis}' for axis in 'xyz'), *(f'torque.{axis}' for axis in 'xyz'))
SENSORS = {
    'imu_link': (
        *(f'orientation.{axis}' for axis in 'xyzw'),
        *(f'angular_velocity.{axis}' for axis in 'xyz'),
        *(f'linear_acceleration.{axis}' for axis in 'xyz'),
    ),
    'l_sole': WRENCH,
    'r_sole': WRENCH,
}
"""State interfaces that the controllers read besides those of the joints, by link."""
BASE_CLASS = 'controller_interface::ControllerInterface'
VALUE = 'double'
BROADCASTER = 'joint_state_broadcaster'
BROADCASTER_CLASS = f'{BROADCASTER}/JointStateBroadcaster'
"""What publishes `joint_states` in ros2_control: here the node, as long as it runs."""
ACTIVE, INACTIVE = 'active', 'inactive'
QUANTITIES = ('position', 'velocity', 'effort')
"""Command and state interfaces of a joint."""


class ControllerServices:
    """
    Services of a ros2_control controller manager, in the namespace `controller_manager`.

    The controllers and the hardware are part of the robot: they are loaded and configured from the
    start, and stay so. The services that would change that log why they do not.

    Parameters
    ----------
    node
        The node that offers them.
    robot
        Name of the robot, which is its namespace; empty if it is alone.
    control
        The control of the robot, whose controllers are listed and switched.
    hardware
        Class of the hardware component that moves the joints, as package/Class.
    rate_hz
        The control rate, reported as the update rate.
    prefix
        Prefix of the names of the sensors' links.

    """

    def __init__(
        self,
        node: Node,
        robot: str,
        control: RobotControl,
        hardware: str,
        rate_hz: float,
        prefix: str = '',
    ) -> None:
        self._control, self._hardware, self._prefix = control, hardware, prefix
        self._log = node.get_logger()
        self._name, self._rate_hz = robot or 'humanoid', round(rate_hz)
        answers: tuple[tuple[Any, str, Callable[[Any, Any], Any]], ...] = (
            (ListControllers, 'list_controllers', self._list),
            (ListControllerTypes, 'list_controller_types', self._list_types),
            (ListHardwareComponents, 'list_hardware_components', self._list_components),
            (ListHardwareInterfaces, 'list_hardware_interfaces', self._list_interfaces),
            (SwitchController, 'switch_controller', self._switch),
            (LoadController, 'load_controller', self._refuse),
            (ConfigureController, 'configure_controller', self._configure),
            (CleanupController, 'cleanup_controller', self._refuse),
            (UnloadController, 'unload_controller', self._refuse),
            (ReloadControllerLibraries, 'reload_controller_libraries', self._refuse),
            (SetHardwareComponentState, 'set_hardware_component_state', self._set_component),
        )
        for kind, name, answer in answers:
            node.create_service(kind, topic(robot, f'controller_manager/{name}'), answer)

    def _list(self, _: Any, response: Any) -> Any:
        response.controller = [self._state(each) for each in self._controllers()]
        return response

    def _list_types(self, _: Any, response: Any) -> Any:
        response.types = sorted({each.kind for each in self._controllers()})
        response.base_classes = [BASE_CLASS] * len(response.types)
        return response

    def _list_components(self, _: Any, response: Any) -> Any:
        response.component = [
            HardwareComponentState(
                name=self._name,
                type='system',
                rw_rate=self._rate_hz,
                class_type=self._hardware,
                plugin_name=self._hardware,
                state=State(id=State.PRIMARY_STATE_ACTIVE, label='active'),
                command_interfaces=self._commands(),
                state_interfaces=self._states(),
            )
        ]
        return response

    def _list_interfaces(self, _: Any, response: Any) -> Any:
        response.command_interfaces, response.state_interfaces = self._commands(), self._states()
        return response

    def _switch(self, request: Any, response: Any) -> Any:
        response.ok, response.message = switch(
            self._control,
            request.activate_controllers,
            request.deactivate_controllers,
            request.strictness,
        )
        return response

    def _configure(self, request: Any, response: Any) -> Any:
        """Agree if the controller is configured and inactive, which need not be changed then."""
        states = {each.name: each.state for each in self._controllers()}
        response.ok = states.get(request.name) == INACTIVE
        if not response.ok:
            self._tell_refusal(request.name, f"'{shortened(request.name)}' is active.")
        return response

    def _refuse(self, request: Any, response: Any) -> Any:
        """Refuse to load or unload anything."""
        self._tell_refusal(
            getattr(request, 'name', ''),
            'The controllers of this robot are part of it: they are loaded and configured from '
            'the start, and stay so. Switch them: ros2 control switch_controllers',
        )
        response.ok = False
        return response

    def _tell_refusal(self, name: str, reason: str) -> None:
        """Log why a request is refused: that there is no such controller, if one is named."""
        known = name in (each.name for each in self._controllers())
        self._log.warning(reason if known or not name else _not_switched(self._control, name))

    def _set_component(self, request: Any, response: Any) -> Any:
        """Agree if the hardware is asked to be what it is, active."""
        target = request.target_state
        is_active = target.id == State.PRIMARY_STATE_ACTIVE or target.label == ACTIVE
        response.ok = request.name == self._name and is_active
        response.state = State(id=State.PRIMARY_STATE_ACTIVE, label=ACTIVE)
        if not response.ok:
            self._log.warning(
                f"The only hardware component is '{self._name}', which is always active."
            )
        return response

    def _controllers(self) -> list[ControllerInfo]:
        return controllers_of(self._control)

    def _state(self, controller: ControllerInfo) -> ControllerState:
        """Build the ControllerState message of a controller."""
        return ControllerState(
            name=controller.name,
            state=controller.state,
            type=controller.kind,
            update_rate=self._rate_hz,
            claimed_interfaces=interfaces_of(controller.claimed),
            required_command_interfaces=interfaces_of(controller.required),
            required_state_interfaces=interfaces_of(controller.read),
        )

    def _commands(self) -> list[HardwareInterface]:
        """List the command interfaces of the joints, with their claims."""
        claimed = {
            name
            for controller in self._controllers()
            for name in interfaces_of(controller.claimed)
        }
        return [
            HardwareInterface(
                name=name, data_type=VALUE, is_available=True, is_claimed=name in claimed
            )
            for name in interfaces_of(self._control.manager.joints)
        ]

    def _states(self) -> list[HardwareInterface]:
        """List the state interfaces of joints and sensors, which need not be claimed."""
        sensors = [
            f'{self._prefix}{sensor}/{value}'
            for sensor, values in SENSORS.items()
            for value in values
        ]
        names = interfaces_of(self._control.manager.joints) + sensors
        return [HardwareInterface(name=name, data_type=VALUE, is_available=True) for name in names]


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
        return _not_switched(control, name)
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


def _not_switched(control: RobotControl, name: str) -> str:
    """Build the message about a name that is not a controller that accepts goals."""
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
