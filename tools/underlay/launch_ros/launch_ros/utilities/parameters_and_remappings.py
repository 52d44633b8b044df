# SPDX-License-Identifier: Apache-2.0
"""Normalize the parameters and remappings of a node, and evaluate them at run time."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
import os
from typing import Any, Union

from launch.launch_context import LaunchContext
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.parameter_descriptions import Parameter, ParameterFile
from launch_ros.utilities.parameter_values import evaluate_value, normalize_value

_Name = tuple[Substitution, ...]
NormalizedParameters = Union[dict[_Name, Any], ParameterFile, Parameter]
EvaluatedParameters = Union[dict[str, Any], str, Parameter]
RemapRule = tuple[list[Substitution], list[Substitution]]


def normalize_parameters(parameters: Any) -> list[NormalizedParameters]:
    """
    Normalize the parameters of a node, so that they can be evaluated at run time.

    Parameters
    ----------
    parameters : Any
        A list of dictionaries, paths of parameter files, ParameterFile and Parameter.

    Returns
    -------
    list of NormalizedParameters
        A flat dictionary, a ParameterFile or a Parameter for each element.

    Raises
    ------
    TypeError
        The argument is not a list, or one of its elements is not supported.

    """
    if not isinstance(parameters, (list, tuple)):
        raise TypeError(
            'the parameters of a node must be a list of dictionaries and files, but got '
            f"{parameters!r} of type '{type(parameters).__name__}'; put it in square brackets"
        )
    return [_normalize(element) for element in parameters]


def _normalize(element: Any) -> NormalizedParameters:
    if isinstance(element, (ParameterFile, Parameter)):
        return element
    if isinstance(element, Mapping):
        return normalize_parameter_dict(element)
    if isinstance(element, (str, os.PathLike, Substitution, Iterable)):
        return ParameterFile(element)
    raise TypeError(
        'an element of the parameters of a node must be a dictionary, the path of a file, or a '
        f"Parameter, but got {element!r} of type '{type(element).__name__}'"
    )


def normalize_parameter_dict(
    parameters: Mapping[Any, Any],
    prefix: _Name = (),
) -> dict[_Name, Any]:
    """
    Flatten a dictionary of parameters; nested names are joined by dots.

    Parameters
    ----------
    parameters : Mapping[Any, Any]
        Values and nested dictionaries, by strings or substitutions.
    prefix
        The prefix of each name, including the dot.

    Returns
    -------
    dict
        Values normalized by `normalize_value`, by the substitutions of the full names.

    Raises
    ------
    TypeError
        A name is not a string or substitution, or a value is not a valid parameter value.

    """
    flat: dict[_Name, Any] = {}
    for key, value in parameters.items():
        if not isinstance(key, (str, Substitution, list, tuple)):
            raise TypeError(
                f'the name of a parameter must be a string or substitutions, but got {key!r} of '
                f"type '{type(key).__name__}'"
            )
        name = (*prefix, *normalize_to_list_of_substitutions(key))
        if isinstance(value, Mapping):
            dot = normalize_to_list_of_substitutions('.')
            flat.update(normalize_parameter_dict(value, (*name, *dot)))
        else:
            flat[name] = normalize_value(value, _describe(name))
    return flat


def _describe(name: _Name) -> str:
    """Return a human-readable description of a parameter name."""
    return ''.join(getattr(part, 'text', None) or part.describe() for part in name)


def evaluate_parameter_dict(
    context: LaunchContext,
    parameters: Mapping[Any, Any],
) -> dict[str, Any]:
    """
    Evaluate a normalized dictionary of parameters.

    Parameters
    ----------
    context
        The launch context used to perform substitutions.
    parameters : Mapping[Any, Any]
        The result of `normalize_parameter_dict`.

    Returns
    -------
    dict
        Plain values by parameter name.

    Raises
    ------
    TypeError
        The substituted value is not a valid parameter value.

    """
    evaluated: dict[str, Any] = {}
    for key, value in parameters.items():
        name = perform_substitutions(context, key)
        evaluated[name] = evaluate_value(context, value, name)
    return evaluated


def evaluate_parameters(
    context: LaunchContext,
    parameters: Iterable[NormalizedParameters],
) -> list[EvaluatedParameters]:
    """
    Evaluate the parameters of a node, in order.

    Parameters
    ----------
    context
        The launch context used to perform substitutions.
    parameters : Iterable[NormalizedParameters]
        The result of `normalize_parameters`.

    Returns
    -------
    list of EvaluatedParameters
        A plain dictionary, the path of a file, or an evaluated Parameter for each element.

    Raises
    ------
    TypeError
        The substituted value is not a valid parameter value.

    """
    return [_evaluate(context, element) for element in parameters]


def _evaluate(context: LaunchContext, element: NormalizedParameters) -> EvaluatedParameters:
    if isinstance(element, ParameterFile):
        return element.evaluate(context)
    if isinstance(element, Parameter):
        element.evaluate(context)
        return element
    return evaluate_parameter_dict(context, element)


def normalize_remap_rule(remap_rule: Any) -> RemapRule:
    """
    Convert both sides of a remapping to substitutions.

    Parameters
    ----------
    remap_rule
        A tuple of the original and the new name.

    Raises
    ------
    TypeError
        The argument is not such a tuple.

    """
    if not isinstance(remap_rule, tuple) or len(remap_rule) != 2:
        raise TypeError(
            "a remapping must be a tuple such as ('from', 'to'), but got "
            f"{remap_rule!r} of type '{type(remap_rule).__name__}'"
        )
    return (
        normalize_to_list_of_substitutions(remap_rule[0]),
        normalize_to_list_of_substitutions(remap_rule[1]),
    )


def normalize_remap_rules(remap_rules: Iterable[Any]) -> list[RemapRule]:
    """
    Convert both sides of each remapping to substitutions.

    Parameters
    ----------
    remap_rules
        As for `normalize_remap_rule`, whose exceptions propagate.

    """
    return [normalize_remap_rule(rule) for rule in remap_rules]


def evaluate_remap_rule(context: LaunchContext, rule: RemapRule) -> tuple[str, str]:
    """
    Evaluate both sides of a remapping to strings.

    Parameters
    ----------
    context
        The launch context used to perform substitutions.
    rule
        The result of `normalize_remap_rule`.

    """
    return perform_substitutions(context, rule[0]), perform_substitutions(context, rule[1])
