# SPDX-License-Identifier: Apache-2.0
"""Merge the sources of a node's parameters into one list."""

from __future__ import annotations

from collections.abc import Iterable
import os
from typing import Any, TYPE_CHECKING

from launch.launch_context import LaunchContext
from launch.logging import get_logger
from launch_ros.parameter_descriptions import Parameter
from launch_ros.utilities.evaluate_parameters_impl import EvaluatedParameters
from launch_ros.utilities.namespace_utils import prefix_namespace
from launch_ros.utilities.parameter_file_content import (
    ParameterFileContent,
    read_parameter_file,
)

if TYPE_CHECKING:
    from rclpy.parameter import Parameter as RosParameter

NamedValue = tuple[str, Any]

_LISTED = 3
_TOLD = 'parameter_files_with_stray_keys'


def named_values(
    context: LaunchContext,
    elements: Iterable[EvaluatedParameters],
    node_name: str,
) -> list[NamedValue]:
    """
    Collect the parameters of a node from dictionaries, files and single parameters.

    Entries without effect are logged, once for each file.

    Parameters
    ----------
    context
        The launch context used to evaluate single parameters.
    elements
        The result of `evaluate_parameters`.
    node_name
        The fully qualified name of the node, which selects the sections of files.

    Returns
    -------
    list of NamedValue
        Names and values, in order; the last value of a name takes precedence.

    Raises
    ------
    FileNotFoundError
        A file is missing.
    ValueError
        A file is not a parameter file.
    TypeError
        A value in a file is not a valid parameter value.

    """
    found: list[NamedValue] = []
    for element in elements:
        if isinstance(element, Parameter):
            found.append(element.evaluate(context))
        elif isinstance(element, dict):
            found += element.items()
        else:
            content = read_parameter_file(os.fspath(element))
            _warn_of_stray_keys(context, content)
            found += content.parameters_of(node_name)
    return found


def _warn_of_stray_keys(context: LaunchContext, content: ParameterFileContent) -> None:
    """Log the entries of a file that have no effect, once for each file."""
    if not content.stray_keys:
        return
    told: set[str] = context.get_locals_as_dict().get(_TOLD) or set()
    context.extend_globals({_TOLD: told})
    if content.path not in told:
        told.add(content.path)
        get_logger('launch_ros.actions.load_composable_nodes').warning(
            "in the parameter file '%s' %s not below any 'ros__parameters' and so without effect",
            content.path,
            _listed(content.stray_keys),
        )


def _listed(keys: list[str]) -> str:
    shown = [f"'{key}'" for key in keys[:_LISTED]]
    if len(keys) > _LISTED:
        shown.append(f'{len(keys) - _LISTED} more')
    return f'{shown[0]} is' if len(shown) == 1 else f'{", ".join(shown[:-1])} and {shown[-1]} are'


def to_parameters_list(
    context: LaunchContext,
    node_name: str,
    namespace: str,
    evaluated_parameters: Iterable[EvaluatedParameters],
) -> list[RosParameter]:
    """
    Convert evaluated parameters to rclpy parameters.

    Parameters
    ----------
    context
        As for `named_values`, whose exceptions propagate.
    node_name, namespace
        Name and namespace of the node; an empty namespace stands for the root.
    evaluated_parameters
        The result of `evaluate_parameters`.

    """
    full_name = prefix_namespace(namespace or '/', node_name.lstrip('/')) or ''
    return [
        to_ros_parameter(name, value)
        for name, value in named_values(context, evaluated_parameters, full_name)
    ]


def to_ros_parameter(name: str, value: Any) -> RosParameter:
    """
    Convert a value to an rclpy parameter of the matching type.

    Parameters
    ----------
    name
        The name of the parameter.
    value
        A scalar or a list of one type; bytes become a byte array.

    """
    from rclpy.parameter import Parameter as RosParameter

    if isinstance(value, bytes):
        value = [bytes([each]) for each in value]
    return RosParameter(name, value=value)
