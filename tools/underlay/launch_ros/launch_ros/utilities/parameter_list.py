# SPDX-License-Identifier: Apache-2.0
"""Merge the sources of a composable node's parameters, including files, into one list."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
import os
import re
from typing import Any, TYPE_CHECKING

from launch.launch_context import LaunchContext
from launch.logging import get_logger
from launch.utilities.type_utils import EXPONENT
from launch_ros.parameter_descriptions import Parameter
from launch_ros.utilities.node_names import prefix_namespace
from launch_ros.utilities.parameter_values import checked
from launch_ros.utilities.parameters_and_remappings import EvaluatedParameters

if TYPE_CHECKING:
    from rclpy.parameter import Parameter as RosParameter

NamedValue = tuple[str, Any]

_LISTED = 3
_TOLD = 'parameter_files_with_stray_keys'

_PARAMETERS = 'ros__parameters'
_WILDCARDS = {'*': '/[^/]+', '**': '(?:/[^/]+)*'}


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


def _warn_of_stray_keys(context: LaunchContext, content: _ParameterFileContent) -> None:
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


@dataclass(frozen=True)
class _ParameterFileContent:
    """The content of a parameter file: parameters by node name, and stray keys."""

    path: str
    sections: list[tuple[str, Mapping[Any, Any]]]
    """Node names, possibly with wildcards, and the mappings below their `ros__parameters`."""
    stray_keys: list[str]
    """The paths of values outside any `ros__parameters`, which have no effect."""

    def parameters_of(self, node_name: str) -> list[tuple[str, Any]]:
        """
        Return the parameters of a node, in the order of the file.

        Parameters
        ----------
        node_name
            The fully qualified name of the node, such as `/front/camera`.

        Returns
        -------
        list of tuple
            Names and values; the names of nested parameters are joined by dots.

        Raises
        ------
        TypeError
            A value in the file is not a valid parameter value.

        """
        found: list[tuple[str, Any]] = []
        for pattern, parameters in self.sections:
            if matches(pattern, node_name):
                found += _flat(parameters, '', self.path)
        return found


def read_parameter_file(path: str) -> _ParameterFileContent:
    """
    Read a YAML parameter file.

    Parameters
    ----------
    path
        The file.

    Raises
    ------
    FileNotFoundError
        The file does not exist; the message suggests similar names.
    ValueError
        The file is not valid YAML, or does not map node names to parameters.

    """
    content = _ParameterFileContent(path, [], [])
    tree = _load(path)
    if not isinstance(tree, Mapping):
        raise ValueError(_misfit(path, '/', tree))
    _collect(tree, '', content)
    return content


def matches(pattern: str, node_name: str) -> bool:
    """
    Whether a key of a parameter file matches a node.

    Parameters
    ----------
    pattern
        The key; `*` matches one token of a name, `**` any number of tokens.
    node_name
        The fully qualified name of the node.

    """
    parts = [part for part in pattern.split('/') if part]
    expression = ''.join(_WILDCARDS.get(part, '/' + re.escape(part)) for part in parts)
    return re.fullmatch(expression, node_name) is not None


def _load(path: str) -> Any:
    import yaml

    try:
        with open(path, encoding='utf-8') as file:
            return yaml.load(file, _loader()) or {}  # noqa: S506  (it is a SafeLoader)
    except FileNotFoundError as error:
        from ros_environment.missing_file import explain_missing_file

        raise FileNotFoundError(explain_missing_file('parameter file', path)) from error
    except yaml.YAMLError as error:
        raise ValueError(f"the parameter file '{path}' is not valid YAML: {error}") from error


@cache
def _loader() -> Any:
    """Return a loader that parses numbers such as 1e-3 like ROS, not as YAML 1.1 strings."""
    import yaml

    class Loader(yaml.SafeLoader):
        pass

    number = re.compile(f'(?:{EXPONENT.pattern})$')
    Loader.add_implicit_resolver('tag:yaml.org,2002:float', number, list('-+.0123456789'))
    return Loader


def _collect(tree: Mapping[Any, Any], prefix: str, content: _ParameterFileContent) -> None:
    """Collect the sections and stray keys below a name, which may be a namespace."""
    for key, value in tree.items():
        where = f'{prefix}/{str(key).lstrip("/")}'
        if key == _PARAMETERS:
            if not isinstance(value or {}, Mapping):
                raise ValueError(_misfit(content.path, where, value))
            content.sections.append((prefix, value or {}))
        elif isinstance(value, Mapping):
            _collect(value, where, content)
        else:
            content.stray_keys.append(where)


def _misfit(path: str, where: str, value: Any) -> str:
    return (
        f"the parameter file '{path}' must have names of nodes, below them '{_PARAMETERS}', and "
        f"below that the parameters, but below '{where}' there is {value!r}"
    )


def _flat(parameters: Mapping[Any, Any], prefix: str, path: str) -> Iterator[tuple[str, Any]]:
    """Yield the parameters; nested names are joined by dots."""
    for key, value in parameters.items():
        name = f'{prefix}{key}'
        if isinstance(value, Mapping):
            yield from _flat(value, f'{name}.', path)
            continue
        try:
            yield name, checked(value, name)
        except TypeError as error:
            raise TypeError(f"in the parameter file '{path}': {error}") from error
