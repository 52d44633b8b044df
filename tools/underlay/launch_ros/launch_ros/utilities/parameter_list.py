# SPDX-License-Identifier: Apache-2.0
"""Bring all that sets parameters of a node into one list."""

from __future__ import annotations

from collections.abc import Iterable
import os
from typing import Any, TYPE_CHECKING

from launch.launch_context import LaunchContext
from launch_ros.parameter_descriptions import Parameter
from launch_ros.utilities.evaluate_parameters_impl import EvaluatedParameters
from launch_ros.utilities.namespace_utils import prefix_namespace
from launch_ros.utilities.parameter_file_content import read_parameter_file
from launch_ros.utilities.parameter_files import is_parameter_file

if TYPE_CHECKING:
    from rclpy.parameter import Parameter as RosParameter

NamedValue = tuple[str, Any]


def named_values(
    context: LaunchContext,
    elements: Iterable[EvaluatedParameters],
    node_name: str,
) -> list[NamedValue]:
    """Return the parameters for the node of this full name; what comes later counts."""
    found: list[NamedValue] = []
    for element in elements:
        if isinstance(element, Parameter):
            found.append(element.evaluate(context))
        elif isinstance(element, dict):
            found += element.items()
        elif is_parameter_file(os.fspath(element)):
            found += read_parameter_file(os.fspath(element), node_name)
    return found


def to_parameters_list(
    context: LaunchContext,
    node_name: str,
    namespace: str,
    evaluated_parameters: Iterable[EvaluatedParameters],
) -> list[RosParameter]:
    """Return rclpy parameters for a node from what `evaluate_parameters` has returned."""
    full_name = prefix_namespace(namespace or '/', node_name.lstrip('/')) or ''
    return [
        to_ros_parameter(name, value)
        for name, value in named_values(context, evaluated_parameters, full_name)
    ]


def to_ros_parameter(name: str, value: Any) -> RosParameter:
    """Return an rclpy parameter with the type that the value has."""
    from rclpy.parameter import Parameter as RosParameter

    if isinstance(value, bytes):
        value = [bytes([each]) for each in value]
    return RosParameter(name, value=value)
