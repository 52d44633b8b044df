# SPDX-License-Identifier: Apache-2.0
"""
Functions that call the services of a controller manager, and read parameter files for it.

All of them raise `ServiceNotFoundError` when the service does not appear within its timeout, and
RuntimeError when it does not answer. A name of a manager or service without a leading slash is
relative to the namespace of the node.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fnmatch import fnmatchcase
import time
from typing import Any, TYPE_CHECKING

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
from rcl_interfaces.srv import SetParameters
import rclpy
from rclpy.duration import Duration
from rclpy.parameter import Parameter
import yaml

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

_LOOK_S = 0.2
_REPORT_S = 10.0
_PARAMETERS = 'ros__parameters'


class ServiceNotFoundError(Exception):
    """A service did not appear in time."""


class bcolors:  # noqa: N801
    """Escape sequences that colour and style text on a terminal."""

    MAGENTA = '\033[95m'
    OKBLUE = '\033[94m'
    OKCYAN = '\033[96m'
    OKGREEN = '\033[92m'
    WARNING = '\033[93m'
    FAIL = '\033[91m'
    ENDC = '\033[0m'
    BOLD = '\033[1m'
    UNDERLINE = '\033[4m'


def service_caller(
    node: Node,
    service_name: str,
    service_type: Any,
    request: Any,
    service_timeout: float = 0.0,
    call_timeout: float = 10.0,
    max_attempts: int = 3,
) -> Any:
    """
    Call a service, and spin the node until it has answered.

    Parameters
    ----------
    node
        The node that calls; nobody else may spin it.
    service_name
        The name of the service.
    service_type
        Its type.
    request
        The request.
    service_timeout
        How long to wait for the service, in s; 0 for no limit.
    call_timeout
        How long to wait for each answer, in s.
    max_attempts
        How often the request is sent if no answer comes.

    Raises
    ------
    ServiceNotFoundError
        The service has not appeared.
    RuntimeError
        It has not answered.

    """
    client = node.create_client(service_type, node.resolve_service_name(service_name))
    try:
        _wait_for_service(node, client, service_timeout)
        for _ in range(max_attempts):
            future = client.call_async(request)
            if _answers(node, future, call_timeout):
                return future.result()
            client.remove_pending_request(future)
            node.get_logger().warning(
                f"The service '{client.srv_name}' has not answered for {call_timeout:g} s"
            )
    finally:
        node.destroy_client(client)
    raise RuntimeError(
        f"The service '{client.srv_name}' has not answered {max_attempts} requests: its process "
        'may be stopped or too busy'
    )


def _wait_for_service(node: Node, client: Any, timeout_s: float) -> None:
    """Wait for a service, and say now and then what is waited for."""
    start_s = reported_s = time.monotonic()
    while not client.service_is_ready():
        now_s = time.monotonic()
        if timeout_s and now_s > start_s + timeout_s:
            raise ServiceNotFoundError(
                f"There is no service '{client.srv_name}' after {timeout_s:g} s: is the "
                'controller manager running, and is that its name?'
            )
        if now_s > reported_s + _REPORT_S:
            reported_s = now_s
            node.get_logger().info(f"Waiting for the service '{client.srv_name}'")
        _spin_once(node)


def _answers(node: Node, future: Any, timeout_s: float) -> bool:
    """Spin until there is an answer, in pieces so that a signal is noticed; return whether."""
    end_s = time.monotonic() + timeout_s
    while not future.done() and time.monotonic() < end_s:
        _spin_once(node)
    return bool(future.done())


def _spin_once(node: Node) -> None:
    """Spin a node once, with the executor that it is in, if any."""
    executor = node.executor
    # A node keeps its last executor when it is taken out of it.
    if executor is not None and node in executor.get_nodes():
        executor.spin_once(timeout_sec=_LOOK_S)
    else:
        rclpy.spin_once(node, timeout_sec=_LOOK_S)


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


def set_controller_parameters(
    node: Node,
    controller_manager_name: str,
    controller_name: str,
    parameter_name: str,
    parameter_value: Any,
) -> bool:
    """
    Set a parameter of a controller at the manager, which uses it when it loads the controller.

    Parameters
    ----------
    node, controller_manager_name
        As for `list_controllers`.
    controller_name
        The name of the controller.
    parameter_name
        The name of the parameter, such as `type`; that of the controller comes before it.
    parameter_value
        A value that a parameter of ROS may have; nothing is set without one.

    Returns
    -------
    bool
        Whether the manager has accepted it; an error is logged if not.

    """
    name = f'{controller_name}.{parameter_name}'
    if not parameter_value:
        return True
    request = SetParameters.Request(
        parameters=[Parameter(name, value=parameter_value).to_parameter_msg()]
    )
    response = service_caller(
        node, f'{controller_manager_name}/set_parameters', SetParameters, request, 10.0
    )
    result = response.results[0]
    if not result.successful:
        node.get_logger().error(
            f"The controller manager does not accept '{name}' = {parameter_value!r}: "
            f'{result.reason or "no reason given"}'
        )
    return bool(result.successful)


def set_controller_parameters_from_param_files(
    node: Node,
    controller_manager_name: str,
    controller_name: str,
    parameter_files: Sequence[str],
    namespace: str | None = None,
) -> bool:
    """
    Tell the manager the type of a controller, and the files with its parameters.

    Parameters
    ----------
    node, controller_manager_name, controller_name
        As for `set_controller_parameters`.
    parameter_files
        The paths of parameter files.
    namespace
        The namespace of the controller; by default that of the node.

    Returns
    -------
    bool
        Whether the manager has accepted all of it.

    Raises
    ------
    RuntimeError
        A file cannot be read, or none of them has parameters of the controller.

    """
    space = namespace or node.get_namespace()
    files = get_params_files_with_controller_parameters(
        node, controller_name, space, parameter_files
    )
    if not files:
        raise RuntimeError(
            f"None of the parameter files has parameters of '{controller_name}' in the namespace "
            f"'{space}': {', '.join(parameter_files)}"
        )
    values = {
        'params_file': files,
        'type': get_parameter_from_param_files(node, controller_name, space, files, 'type'),
        'fallback_controllers': get_parameter_from_param_files(
            node, controller_name, space, files, 'fallback_controllers'
        ),
    }
    return all(
        set_controller_parameters(node, controller_manager_name, controller_name, name, value)
        for name, value in values.items()
    )


def get_params_files_with_controller_parameters(
    node: Node, controller_name: str, namespace: str, parameter_files: Iterable[str]
) -> list[str]:
    """
    Find the files with parameters of a controller.

    Parameters
    ----------
    node
        Not used; ROS 2 has it.
    controller_name, namespace
        The name of the controller, and its namespace.
    parameter_files
        The paths of parameter files.

    Raises
    ------
    RuntimeError
        A file cannot be read.

    """
    return [path for path in parameter_files if any(_sections(path, namespace, controller_name))]


def get_parameter_from_param_files(
    node: Node,
    controller_name: str,
    namespace: str,
    parameter_files: Iterable[str],
    parameter_name: str,
) -> Any:
    """
    Read a parameter of a controller from files; the last value counts.

    Parameters
    ----------
    node, controller_name, namespace, parameter_files
        As for `get_params_files_with_controller_parameters`.
    parameter_name
        The name of the parameter, with dots between the names of tables.

    Returns
    -------
    Any
        The value; None if no file has one.

    Raises
    ------
    RuntimeError
        A file cannot be read.

    """
    found = None
    for path in parameter_files:
        for section in _sections(path, namespace, controller_name):
            value = _value(section, parameter_name)
            found = found if value is None else value
    return found


def _value(section: Any, name: str) -> Any:
    """Return the value of a parameter, whose name may have dots or be nested, or a mixture."""
    if not isinstance(section, dict):
        return None
    if name in section:
        return section[name]
    first, _, rest = name.partition('.')
    return _value(section.get(first), rest) if rest else None


def _sections(path: str, namespace: str, controller: str) -> Iterator[dict[str, Any]]:
    """Yield the tables of parameters in a file that are for a controller, in their order."""
    try:
        with open(path, encoding='utf-8') as stream:
            content = yaml.safe_load(stream)
    except (OSError, ValueError, yaml.YAMLError) as error:
        raise RuntimeError(f"The parameter file '{path}' cannot be read: {error}") from error
    full_name = f'/{namespace.strip("/")}/{controller}'.replace('//', '/')
    for name, section in _nodes(content, ''):
        pattern = name if name.startswith('/') else f'/**/{name}'
        if section and fnmatchcase(full_name, pattern.replace('/**', '*')):
            yield section


def _nodes(content: Any, prefix: str) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield the names of nodes in a parameter file, namespaces included, with their parameters."""
    if not isinstance(content, dict):
        return
    for name, value in content.items():
        if name == _PARAMETERS and isinstance(value, dict):
            yield prefix, value
        elif name != _PARAMETERS:
            yield from _nodes(value, f'{prefix}/{name}' if prefix else str(name))
