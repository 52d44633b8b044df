# SPDX-License-Identifier: Apache-2.0
"""Parameters of controllers: read from parameter files, and set at the controller manager."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fnmatch import fnmatchcase
from typing import Any, TYPE_CHECKING

from controller_manager._service_caller import service_caller
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
import yaml

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = [
    'get_parameter_from_param_files',
    'get_params_files_with_controller_parameters',
    'set_controller_parameters',
    'set_controller_parameters_from_param_files',
]

_PARAMETERS = 'ros__parameters'


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
