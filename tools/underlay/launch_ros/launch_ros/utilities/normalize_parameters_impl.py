# SPDX-License-Identifier: Apache-2.0
"""Normalize the parameters of a node."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
import os
from typing import Any, Union

from launch.substitution import Substitution
from launch.utilities.normalize_to_list_of_substitutions_impl import (
    normalize_to_list_of_substitutions,
)
from launch_ros.parameter_descriptions import Parameter, ParameterFile
from launch_ros.utilities.parameter_values import normalize_value

Name = tuple[Substitution, ...]
NormalizedParameters = Union[dict[Name, Any], ParameterFile, Parameter]


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
    prefix: Name = (),
) -> dict[Name, Any]:
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
    flat: dict[Name, Any] = {}
    for key, value in parameters.items():
        if not isinstance(key, (str, Substitution, list, tuple)):
            raise TypeError(
                f'the name of a parameter must be a text or substitutions, but got {key!r} of '
                f"type '{type(key).__name__}'"
            )
        name = (*prefix, *normalize_to_list_of_substitutions(key))
        if isinstance(value, Mapping):
            dot = normalize_to_list_of_substitutions('.')
            flat.update(normalize_parameter_dict(value, (*name, *dot)))
        else:
            flat[name] = normalize_value(value, _describe(name))
    return flat


def _describe(name: Name) -> str:
    """Return a human-readable description of a parameter name."""
    return ''.join(getattr(part, 'text', None) or part.describe() for part in name)
