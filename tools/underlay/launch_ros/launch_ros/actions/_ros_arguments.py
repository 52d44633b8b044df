# SPDX-License-Identifier: Apache-2.0
"""The arguments that tell a node about its parameters and remappings."""

from __future__ import annotations

from collections.abc import Iterable
import os
from typing import Any

from launch._before_start import note_file
from launch.launch_context import LaunchContext
from launch.logging import get_logger
from launch_ros.actions._node_names import NodeNames
from launch_ros.parameter_descriptions import Parameter
from launch_ros.utilities.evaluate_parameters_impl import evaluate_parameters, EvaluatedParameters
from launch_ros.utilities.normalize_parameters_impl import NormalizedParameters
from launch_ros.utilities.normalize_remap_rules_impl import evaluate_remap_rule, RemapRule
from launch_ros.utilities.parameter_files import write_parameter_file
from launch_ros.utilities.yaml_text import flow_text


def global_arguments(context: LaunchContext, names: NodeNames) -> list[str]:
    """Return the parameters and files that are set for all nodes, in order."""
    arguments = []
    for item in context.launch_configurations.get('global_params', []):
        if isinstance(item, tuple):
            arguments += ['-p', f'{item[0]}:={_global_text(item[1])}']
        else:
            _note(context, os.fspath(item), names)
            arguments += ['--params-file', os.fspath(item)]
    return arguments


def _global_text(value: Any) -> str:
    """Return a scalar as Python writes it, which ROS understands, and a list as YAML."""
    return flow_text(value) if isinstance(value, (list, tuple)) else str(value)


def own_parameter_arguments(
    context: LaunchContext,
    parameters: Iterable[NormalizedParameters],
    names: NodeNames,
) -> list[str]:
    """Return the parameters of one node, in order; dictionaries are written to files."""
    arguments = []
    for element in evaluate_parameters(context, parameters):
        arguments += _parameter_argument(context, element, names)
    return arguments


def _parameter_argument(
    context: LaunchContext,
    element: EvaluatedParameters,
    names: NodeNames,
) -> list[str]:
    if isinstance(element, Parameter):
        return ['-p', element.get_parameter_rule()]
    if isinstance(element, dict):
        return ['--params-file', write_parameter_file(names.parameter_key, element)]
    if os.path.isfile(element):
        _note(context, element, names)
        return ['--params-file', element]
    _warn_of_missing_file(element)
    return []


def _note(context: LaunchContext, path: str, names: NodeNames) -> None:
    """Let the file be compared with the nodes, as long as nothing has been started."""
    if context._before_start is not None:
        from launch_ros.actions._parameter_files_check import ParameterFilesCheck

        note_file(context, path)
        context._before_start.check_of_type(ParameterFilesCheck).add(path, names)


def _warn_of_missing_file(path: str) -> None:
    """Warn in the known words, then with what may help."""
    from launch._missing_file import explain_missing_file

    logger = get_logger('launch_ros.actions.node')
    logger.warning('Parameter file path is not a file: %s', path)
    advice = explain_missing_file('file', path)
    logger.warning('The node gets no parameters from it, because %s', advice)


def remap_arguments(
    context: LaunchContext,
    rules: Iterable[RemapRule],
) -> tuple[list[str], list[tuple[str, str]]]:
    """Return the remappings of all nodes and of this one as arguments, and as pairs."""
    pairs: list[tuple[str, str]] = list(context.launch_configurations.get('ros_remaps', []))
    pairs += [evaluate_remap_rule(context, rule) for rule in rules]
    arguments = [word for source, target in pairs for word in ('-r', f'{source}:={target}')]
    return arguments, pairs
