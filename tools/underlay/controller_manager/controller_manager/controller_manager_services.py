# SPDX-License-Identifier: Apache-2.0
"""
Functions that call the services of a controller manager, and read parameter files for it.

All of them raise `ServiceNotFoundError` when the service does not appear within its timeout, and
RuntimeError when it does not answer. A name of a manager or service without a leading slash is
relative to the namespace of the node.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TYPE_CHECKING

from controller_manager._controller_parameters import (
    get_parameter_from_param_files,
    get_params_files_with_controller_parameters,
    set_controller_parameters,
    set_controller_parameters_from_param_files,
)
from controller_manager._service_caller import bcolors, service_caller, ServiceNotFoundError
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
from rclpy.duration import Duration

if TYPE_CHECKING:
    from lifecycle_msgs.msg import State
    from rclpy.node import Node

__all__ = [
    'ServiceNotFoundError',
    'bcolors',
    'configure_controller',
    'get_parameter_from_param_files',
    'get_params_files_with_controller_parameters',
    'list_controller_types',
    'list_controllers',
    'list_hardware_components',
    'list_hardware_interfaces',
    'load_controller',
    'reload_controller_libraries',
    'service_caller',
    'set_controller_parameters',
    'set_controller_parameters_from_param_files',
    'set_hardware_component_state',
    'switch_controllers',
    'unload_controller',
]


def _call(
    node: Node,
    manager: str,
    name: str,
    kind: Any,
    service_timeout: float,
    call_timeout: float,
    /,
    **fields: Any,
) -> Any:
    request = kind.Request(**fields)
    return service_caller(node, f'{manager}/{name}', kind, request, service_timeout, call_timeout)


def list_controllers(
    node: Node,
    controller_manager_name: str,
    service_timeout: float = 0.0,
    call_timeout: float = 10.0,
) -> ListControllers.Response:
    """
    List the controllers that are loaded.

    Parameters
    ----------
    node
        The node that calls.
    controller_manager_name
        The name of the manager.
    service_timeout, call_timeout
        As for `service_caller`.

    """
    return _call(
        node,
        controller_manager_name,
        'list_controllers',
        ListControllers,
        service_timeout,
        call_timeout,
    )


def list_controller_types(
    node: Node,
    controller_manager_name: str,
    service_timeout: float = 0.0,
    call_timeout: float = 10.0,
) -> ListControllerTypes.Response:
    """
    List the types of controllers that can be loaded.

    Parameters
    ----------
    node, controller_manager_name, service_timeout, call_timeout
        As for `list_controllers`.

    """
    return _call(
        node,
        controller_manager_name,
        'list_controller_types',
        ListControllerTypes,
        service_timeout,
        call_timeout,
    )


def list_hardware_components(
    node: Node,
    controller_manager_name: str,
    service_timeout: float = 0.0,
    call_timeout: float = 10.0,
) -> ListHardwareComponents.Response:
    """
    List the hardware components, with their states and interfaces.

    Parameters
    ----------
    node, controller_manager_name, service_timeout, call_timeout
        As for `list_controllers`.

    """
    return _call(
        node,
        controller_manager_name,
        'list_hardware_components',
        ListHardwareComponents,
        service_timeout,
        call_timeout,
    )


def list_hardware_interfaces(
    node: Node,
    controller_manager_name: str,
    service_timeout: float = 0.0,
    call_timeout: float = 10.0,
) -> ListHardwareInterfaces.Response:
    """
    List the command and state interfaces of the hardware.

    Parameters
    ----------
    node, controller_manager_name, service_timeout, call_timeout
        As for `list_controllers`.

    """
    return _call(
        node,
        controller_manager_name,
        'list_hardware_interfaces',
        ListHardwareInterfaces,
        service_timeout,
        call_timeout,
    )


def load_controller(
    node: Node,
    controller_manager_name: str,
    controller_name: str,
    service_timeout: float = 0.0,
    call_timeout: float = 10.0,
) -> LoadController.Response:
    """
    Load a controller, whose type the manager knows from a parameter.

    Parameters
    ----------
    node, controller_manager_name, service_timeout, call_timeout
        As for `list_controllers`.
    controller_name
        The name of the controller.

    """
    return _call(
        node,
        controller_manager_name,
        'load_controller',
        LoadController,
        service_timeout,
        call_timeout,
        name=controller_name,
    )


def configure_controller(
    node: Node,
    controller_manager_name: str,
    controller_name: str,
    service_timeout: float = 0.0,
    call_timeout: float = 10.0,
) -> ConfigureController.Response:
    """
    Configure a controller that is loaded; it is inactive then.

    Parameters
    ----------
    node, controller_manager_name, controller_name, service_timeout, call_timeout
        As for `load_controller`.

    """
    return _call(
        node,
        controller_manager_name,
        'configure_controller',
        ConfigureController,
        service_timeout,
        call_timeout,
        name=controller_name,
    )


def unload_controller(
    node: Node,
    controller_manager_name: str,
    controller_name: str,
    service_timeout: float = 0.0,
    call_timeout: float = 10.0,
) -> UnloadController.Response:
    """
    Unload a controller that is not active.

    Parameters
    ----------
    node, controller_manager_name, controller_name, service_timeout, call_timeout
        As for `load_controller`.

    """
    return _call(
        node,
        controller_manager_name,
        'unload_controller',
        UnloadController,
        service_timeout,
        call_timeout,
        name=controller_name,
    )


def reload_controller_libraries(
    node: Node,
    controller_manager_name: str,
    force_kill: bool,
    service_timeout: float = 0.0,
    call_timeout: float = 10.0,
) -> ReloadControllerLibraries.Response:
    """
    Load the libraries of controllers anew.

    Parameters
    ----------
    node, controller_manager_name, service_timeout, call_timeout
        As for `list_controllers`.
    force_kill
        Whether controllers that are running are stopped for that.

    """
    return _call(
        node,
        controller_manager_name,
        'reload_controller_libraries',
        ReloadControllerLibraries,
        service_timeout,
        call_timeout,
        force_kill=force_kill,
    )


def set_hardware_component_state(
    node: Node,
    controller_manager_name: str,
    component_name: str,
    lifecyle_state: State,
    service_timeout: float = 0.0,
    call_timeout: float = 10.0,
) -> SetHardwareComponentState.Response:
    """
    Bring a hardware component to a state of its lifecycle.

    Parameters
    ----------
    node, controller_manager_name, service_timeout, call_timeout
        As for `list_controllers`.
    component_name
        The name of the component.
    lifecyle_state
        The state, by its id or its label; the parameter is spelt as in ROS 2.

    """
    return _call(
        node,
        controller_manager_name,
        'set_hardware_component_state',
        SetHardwareComponentState,
        service_timeout,
        call_timeout,
        name=component_name,
        target_state=lifecyle_state,
    )


def switch_controllers(
    node: Node,
    controller_manager_name: str,
    deactivate_controllers: Sequence[str],
    activate_controllers: Sequence[str],
    strict: bool,
    activate_asap: bool,
    timeout: float,
    call_timeout: float = 10.0,
    service_timeout: float = 0.0,
) -> SwitchController.Response:
    """
    Deactivate and activate controllers in one step.

    Parameters
    ----------
    node, controller_manager_name, call_timeout, service_timeout
        As for `list_controllers`.
    deactivate_controllers, activate_controllers
        The names of the controllers.
    strict
        Whether to switch all or none, rather than those that can be switched.
    activate_asap
        Whether to activate each one as soon as its hardware is ready.
    timeout
        How long the manager may take for it, in s; 0 for no limit.

    """
    strictness = (
        SwitchController.Request.STRICT if strict else SwitchController.Request.BEST_EFFORT
    )
    return _call(
        node,
        controller_manager_name,
        'switch_controller',
        SwitchController,
        service_timeout,
        max(call_timeout, timeout),
        activate_controllers=list(activate_controllers),
        deactivate_controllers=list(deactivate_controllers),
        strictness=strictness,
        activate_asap=activate_asap,
        timeout=Duration(seconds=timeout).to_msg(),
    )
