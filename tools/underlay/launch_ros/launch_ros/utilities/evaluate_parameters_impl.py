# SPDX-License-Identifier: Apache-2.0
"""Evaluate the parameters of a node."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Union

from launch.launch_context import LaunchContext
from launch.utilities.perform_substitutions_impl import perform_substitutions
from launch_ros.parameter_descriptions import Parameter, ParameterFile
from launch_ros.utilities.normalize_parameters_impl import NormalizedParameters
from launch_ros.utilities.parameter_values import evaluate_value

EvaluatedParameters = Union[dict[str, Any], str, Parameter]


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
