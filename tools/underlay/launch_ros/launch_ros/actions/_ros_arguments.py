# SPDX-License-Identifier: Apache-2.0
"""ROS arguments for the command line of a node: parameters, remappings and extensions."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
import os
from typing import Any, Optional, TYPE_CHECKING, Union

from launch.launch_context import LaunchContext
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.parameter_descriptions import Parameter
from launch_ros.utilities.node_names import NodeNames
from launch_ros.utilities.parameter_files import flow_text, is_parameter_file, write_parameter_file
from launch_ros.utilities.parameters_and_remappings import (
    evaluate_parameters,
    evaluate_remap_rule,
    EvaluatedParameters,
    NormalizedParameters,
    RemapRule,
)
from ros_environment.entry_points import entry_points_of

if TYPE_CHECKING:
    from launch_ros.actions.node import Node

ParameterArgument = tuple[str, bool]
"""A file path and True, or a rule such as `name:=value` and False."""

_GROUP = 'launch_ros.node_action'


def global_arguments(context: LaunchContext, names: NodeNames) -> list[str]:
    """
    Format the global parameters and parameter files as ROS arguments, in order.

    Parameters
    ----------
    context
        The launch context; its configuration `global_params` holds the global parameters.
    names
        The names of the node; parameter files are checked against them.

    Returns
    -------
    list of str
        Pairs of `-p` and a rule, or `--params-file` and a path.

    """
    arguments = []
    for element in global_parameters(context):
        if isinstance(element, dict):
            for name, value in element.items():
                arguments += ['-p', f'{name}:={_global_text(value)}']
        else:
            _note(context, element, names)
            arguments += ['--params-file', element]
    return arguments


def global_parameters(context: LaunchContext) -> list[Union[dict[str, Any], str]]:
    """
    Return the global parameters and the paths of global parameter files, in order.

    Parameters
    ----------
    context
        The launch context; its configuration `global_params` holds the global parameters.

    Returns
    -------
    list
        A dictionary with one entry for each parameter, a path for each file.

    """
    return [
        {item[0]: item[1]} if isinstance(item, tuple) else os.fspath(item)
        for item in context.launch_configurations.get('global_params', [])
    ]


def _global_text(value: Any) -> str:
    """Format a scalar as in Python, which ROS can parse, and a list as YAML."""
    return flow_text(value) if isinstance(value, (list, tuple)) else str(value)


def own_parameters(
    context: LaunchContext,
    parameters: Iterable[NormalizedParameters],
    names: NodeNames,
) -> list[ParameterArgument]:
    """
    Evaluate the parameters of a node, in order; dictionaries are written to files.

    Missing files are logged and skipped.

    Parameters
    ----------
    context
        The launch context used to perform substitutions.
    parameters : Iterable[NormalizedParameters]
        The result of `normalize_parameters`.
    names
        The names of the node; written files match any node unless both are known.

    Returns
    -------
    list of ParameterArgument
        Paths and rules, for `parameter_arguments`.

    """
    found = (_own(context, each, names) for each in evaluate_parameters(context, parameters))
    return [each for each in found if each is not None]


def _own(
    context: LaunchContext,
    element: EvaluatedParameters,
    names: NodeNames,
) -> Optional[ParameterArgument]:
    if isinstance(element, Parameter):
        return element.get_parameter_rule(), False
    if isinstance(element, dict):
        return write_parameter_file(names.parameter_key, element), True
    if not is_parameter_file(element):
        return None
    _note(context, element, names)
    return element, True


def parameter_arguments(parameters: Iterable[ParameterArgument]) -> list[str]:
    """
    Format parameters as ROS arguments.

    Parameters
    ----------
    parameters : Iterable[ParameterArgument]
        A path and True, or a rule and False, for each.

    Returns
    -------
    list of str
        Pairs of `--params-file` and a path, or `-p` and a rule.

    """
    return [
        word
        for text, is_file in parameters
        for word in ('--params-file' if is_file else '-p', text)
    ]


def _note(context: LaunchContext, path: str, names: NodeNames) -> None:
    """Register the file for the check against node names, unless a process has started."""
    if context.run.before_start is not None:
        from launch_ros.utilities.parameter_file_check import ParameterFilesCheck

        context.run.note_file(path)
        context.run.before_start.check_of_type(ParameterFilesCheck).add(path, names)


def remap_pairs(context: LaunchContext, rules: Iterable[RemapRule]) -> list[tuple[str, str]]:
    """
    Evaluate the global remappings, followed by those of a node.

    Parameters
    ----------
    context
        The launch context; its configuration `ros_remaps` holds the global remappings.
    rules
        The remappings of the node, with both sides as substitutions.

    Returns
    -------
    list of tuple
        The original and the new name, both as strings.

    """
    pairs: list[tuple[str, str]] = list(context.launch_configurations.get('ros_remaps', []))
    return pairs + [evaluate_remap_rule(context, rule) for rule in rules]


def remap_rules(pairs: Iterable[tuple[str, str]]) -> list[str]:
    """
    Format remappings as rules `from:=to`.

    Parameters
    ----------
    pairs
        The original and the new name of each remapping.

    """
    return [f'{source}:={target}' for source, target in pairs]


def rule_arguments(rules: Iterable[str]) -> list[str]:
    """
    Format remapping rules as ROS arguments, each preceded by `-r`.

    Parameters
    ----------
    rules
        Rules such as `from:=to` or `__node:=name`.

    """
    return [word for rule in rules for word in ('-r', rule)]


class NodeActionExtension:
    """Base class of extensions that register as entry points of `launch_ros.node_action`."""

    NAME: Optional[str] = None
    EXTENSION_POINT_VERSION = '0.1'

    def prepare_for_execute(
        self,
        context: LaunchContext,
        ros_specific_arguments: dict[str, Any],
        node_action: Node,
    ) -> tuple[list[Any], dict[str, Any]]:
        """
        Extend the command line of a node; to be overridden by subclasses.

        Added arguments may refer to `ros_specific_arguments` by a LocalSubstitution.

        Parameters
        ----------
        context
            The launch context.
        ros_specific_arguments
            The rules `__node:=...` under `name` and `__ns:=...` under `ns`, each only if known.
        node_action
            The action that is about to start the node.

        Returns
        -------
        tuple
            The arguments to add, as strings or substitutions, and the rules to use instead.

        """
        return [], ros_specific_arguments


def extend_node(
    context: LaunchContext,
    ros_specific_arguments: dict[str, Any],
    node: Node,
) -> tuple[list[str], dict[str, Any]]:
    """
    Apply all installed extensions to the command line of a node.

    Parameters
    ----------
    context
        The launch context; receives the local `ros_specific_arguments` if arguments are added.
    ros_specific_arguments
        The rules for the name and the namespace, by `name` and `ns`.
    node
        The action that is about to start the node.

    Returns
    -------
    tuple
        The arguments to add, as strings, and the rules to use.

    """
    added: list[Any] = []
    for extension in extensions():
        more, ros_specific_arguments = extension.prepare_for_execute(
            context, ros_specific_arguments, node
        )
        added += more
    if added:
        context.extend_locals({'ros_specific_arguments': ros_specific_arguments})
    words = [
        perform_substitutions(context, normalize_to_list_of_substitutions(word)) for word in added
    ]
    return words, ros_specific_arguments


@cache
def extensions() -> list[Any]:
    """Instantiate all extensions; log and skip those that cannot be loaded."""
    found = []
    for entry_point in entry_points_of(_GROUP):
        try:
            found.append(entry_point.load()())
        except Exception as error:
            from launch.logging import get_logger

            get_logger('launch_ros.actions.node').warning(
                "the extension '%s' (%s) of nodes cannot be loaded and is skipped: %s: %s",
                entry_point.name,
                entry_point.value,
                type(error).__name__,
                error,
            )
    return found
