# SPDX-License-Identifier: Apache-2.0
"""
A process that answers as controller managers do.

One has a controller that walks, and an arm; the other one, `legs/controller_manager`, has a
controller that is not configured, and loads others.
"""

from __future__ import annotations

import signal
import sys
from typing import Any

from controller_manager_msgs.msg import (
    ChainConnection,
    ControllerState,
    HardwareComponentState,
    HardwareInterface,
)
from controller_manager_msgs.srv import (
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
from lifecycle_msgs.msg import State
from rcl_interfaces.msg import SetParametersResult
from rcl_interfaces.srv import SetParameters
import rclpy
from rclpy.executors import ExternalShutdownException

ARM = 'arm_controller'
JTC = 'joint_trajectory_controller/JointTrajectoryController'


class Manager:
    """Its answers."""

    def __init__(self, node: Any) -> None:
        """Offer the services."""
        self._active = True
        for kind, name, answer in (
            (ListControllers, 'list_controllers', self._controllers),
            (ListControllerTypes, 'list_controller_types', self._types),
            (ListHardwareComponents, 'list_hardware_components', self._components),
            (ListHardwareInterfaces, 'list_hardware_interfaces', self._interfaces),
            (SwitchController, 'switch_controller', self._switch),
        ):
            node.create_service(kind, f'controller_manager/{name}', answer)

    def _controllers(self, _: Any, response: Any) -> Any:
        arm = ControllerState(
            name=ARM,
            state='active' if self._active else 'inactive',
            type=JTC,
            claimed_interfaces=['elbow/position'] if self._active else [],
            required_command_interfaces=['elbow/position'],
            required_state_interfaces=['elbow/position', 'elbow/velocity'],
            chain_connections=[ChainConnection(name='pid', reference_interfaces=['elbow'])],
        )
        response.controller = [arm, ControllerState(name='walk', state='active', type='w/Walk')]
        return response

    def _types(self, _: Any, response: Any) -> Any:
        response.types, response.base_classes = [JTC, 'w/Walk'], ['base', 'base']
        return response

    def _components(self, _: Any, response: Any) -> Any:
        commands, states = self._both()
        response.component = [
            HardwareComponentState(
                name='robot',
                type='system',
                plugin_name='simulation/Backend',
                rw_rate=100,
                state=State(id=3, label='active'),
                command_interfaces=commands,
                state_interfaces=states,
            )
        ]
        return response

    def _interfaces(self, _: Any, response: Any) -> Any:
        response.command_interfaces, response.state_interfaces = self._both()
        return response

    def _both(self) -> tuple[list[HardwareInterface], list[HardwareInterface]]:
        commands = [
            HardwareInterface(name='knee/position', is_available=True, is_claimed=True),
            HardwareInterface(name='elbow/position', is_available=True, is_claimed=self._active),
            HardwareInterface(name='wheel/velocity'),
        ]
        return commands, [HardwareInterface(name=f'{name}/position') for name in ('knee', 'elbow')]

    def _switch(self, request: Any, response: Any) -> Any:
        strange = {*request.activate_controllers, *request.deactivate_controllers} - {ARM}
        strict = request.strictness == SwitchController.Request.STRICT
        response.ok = not strange if strict else strange == set()
        response.message = f"There is no '{min(strange)}'." if strange else ''
        if response.ok:
            self._active = bool(request.activate_controllers)
        return response


class Legs:
    """The answers of a manager that loads what it knows the type of, and has a chain."""

    def __init__(self, node: Any) -> None:
        """Offer the services."""
        self._states = {'leg': 'unconfigured'}
        self._typed = {'foot'}
        self._hardware = State(id=State.PRIMARY_STATE_INACTIVE, label='inactive')
        for kind, name, answer in (
            (ListControllers, 'list_controllers', self._controllers),
            (ListControllerTypes, 'list_controller_types', self._types),
            (ConfigureController, 'configure_controller', self._configure),
            (SwitchController, 'switch_controller', self._switch),
            (LoadController, 'load_controller', self._load),
            (UnloadController, 'unload_controller', self._unload),
            (ReloadControllerLibraries, 'reload_controller_libraries', self._reload),
            (ListHardwareComponents, 'list_hardware_components', self._components),
            (SetHardwareComponentState, 'set_hardware_component_state', self._set_component),
            (SetParameters, 'set_parameters', self._set_parameters),
        ):
            node.create_service(kind, f'legs/controller_manager/{name}', answer)

    def _controllers(self, _: Any, response: Any) -> Any:
        response.controller = [
            ControllerState(name=name, state=state, type='l/Leg')
            for name, state in self._states.items()
        ]
        return response

    def _types(self, _: Any, response: Any) -> Any:
        response.types, response.base_classes = ['l/Leg'], ['base']
        return response

    def _configure(self, request: Any, response: Any) -> Any:
        self._states[request.name] = 'inactive'
        response.ok = request.name in ('leg', 'foot')
        return response

    def _switch(self, request: Any, response: Any) -> Any:
        self._states |= dict.fromkeys(request.activate_controllers, 'active')
        self._states |= dict.fromkeys(request.deactivate_controllers, 'inactive')
        response.ok = True
        return response

    def _load(self, request: Any, response: Any) -> Any:
        response.ok = request.name in self._typed
        if response.ok:
            self._states[request.name] = 'unconfigured'
        return response

    def _unload(self, request: Any, response: Any) -> Any:
        response.ok = self._states[request.name] != 'active'
        if response.ok:
            del self._states[request.name]
        return response

    def _reload(self, request: Any, response: Any) -> Any:
        response.ok = request.force_kill or 'active' not in self._states.values()
        if response.ok:
            self._states = {}
        return response

    def _components(self, _: Any, response: Any) -> Any:
        response.component = [HardwareComponentState(name='motors', state=self._hardware)]
        return response

    def _set_component(self, request: Any, response: Any) -> Any:
        response.ok = request.target_state.id != State.PRIMARY_STATE_UNCONFIGURED
        if response.ok:
            self._hardware = request.target_state
        response.state = self._hardware
        return response

    def _set_parameters(self, request: Any, response: Any) -> Any:
        names = [each.name for each in request.parameters]
        self._typed |= {name.removesuffix('.type') for name in names if name.endswith('.type')}
        response.results = [SetParametersResult(successful=True) for _ in names]
        return response


def main() -> None:
    """Answer until a signal comes."""
    try:
        rclpy.init()
        node = rclpy.create_node('host', namespace=sys.argv[1] if sys.argv[1:] else '')
        managers = Manager(node), Legs(node)
        print('ready', flush=True)
        rclpy.spin(node)
        del managers
    except (KeyboardInterrupt, ExternalShutdownException):
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
