# SPDX-License-Identifier: Apache-2.0
"""Services of a controller manager: `ros2 control` lists and switches controllers."""

from __future__ import annotations

from collections.abc import Callable
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
from humanoid_common.naming import shortened
from humanoid_control.hosting.controller_switch import (
    ACTIVE,
    ControllerInfo,
    controllers_of,
    INACTIVE,
    interfaces_of,
    not_switched,
    switch,
)
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
        self._log.warning(reason if known or not name else not_switched(self._control, name))

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
