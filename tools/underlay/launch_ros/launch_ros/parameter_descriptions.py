# SPDX-License-Identifier: Apache-2.0
"""Descriptions of parameters, parameter values and parameter files."""

from __future__ import annotations

import os
from typing import Any, Optional

from launch.launch_context import LaunchContext
from launch.substitution import (
    SomeSubstitutionsType,
    SomeSubstitutionsType_types_tuple,
    Substitution,
)
from launch.utilities import (
    ensure_argument_type,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from launch.utilities.type_utils import normalize_typed_substitution, perform_typed_substitution

_NOT_YET = object()


class ParameterValue:
    """
    The value of a parameter, with the type that it must have.

    Parameters
    ----------
    value
        A scalar, a list or substitutions.
    value_type
        The type, such as `str` or `list[int]`; None applies YAML rules to strings.

    Raises
    ------
    TypeError
        The value is neither of this type nor a string or substitution.

    """

    def __init__(self, value: Any, *, value_type: Optional[Any] = None) -> None:
        self.__value = normalize_typed_substitution(value, value_type)
        self.__value_type = value_type
        self.__evaluated: Any = _NOT_YET

    @property
    def value(self) -> Any:
        """Return the value, or the substitutions that evaluate to it."""
        return self.__value

    @property
    def value_type(self) -> Optional[Any]:
        """Return the type; None if YAML rules apply."""
        return self.__value_type

    def evaluate(self, context: LaunchContext) -> Any:
        """
        Evaluate the value on the first call; later calls return the same result.

        Parameters
        ----------
        context
            The launch context used to perform substitutions.

        Raises
        ------
        ValueError
            The substituted text cannot be converted to the type.

        """
        if self.__evaluated is _NOT_YET:
            self.__evaluated = perform_typed_substitution(context, self.__value, self.__value_type)
        return self.__evaluated

    def __repr__(self) -> str:
        """Return a human-readable representation."""
        return f'{type(self).__name__}(value={self.__value!r}, value_type={self.__value_type!r})'


class Parameter:
    """
    A single parameter, which is given on the command line of the node.

    Parameters
    ----------
    name
        The name of the parameter.
    value, value_type
        As for `ParameterValue`.

    Raises
    ------
    TypeError
        The name is not a string or substitution, or the value is not of the type.

    """

    def __init__(
        self,
        name: SomeSubstitutionsType,
        value: Any,
        *,
        value_type: Optional[Any] = None,
    ) -> None:
        ensure_argument_type(name, SomeSubstitutionsType_types_tuple, 'name', 'Parameter')
        self.__name = normalize_to_list_of_substitutions(name)
        self.__value = ParameterValue(value, value_type=value_type)
        self.__rule: Optional[str] = None

    def evaluate(self, context: LaunchContext) -> tuple[str, Any]:
        """
        Evaluate the name and the value; required before `get_parameter_rule`.

        Parameters
        ----------
        context
            The launch context used to perform substitutions.

        Returns
        -------
        tuple
            The name and the value.

        Raises
        ------
        TypeError
            The value is not a valid parameter value.

        """
        from launch_ros.utilities.parameter_files import flow_text
        from launch_ros.utilities.parameter_values import checked

        name = perform_substitutions(context, self.__name)
        value = checked(self.__value.evaluate(context), name)
        self.__rule = f'{name}:={flow_text(value)}'
        return name, value

    def get_parameter_rule(self) -> str:
        """Return the rule `name:=value`; the parameter must have been evaluated."""
        if self.__rule is None:
            raise RuntimeError('a Parameter has no rule before it is evaluated')
        return self.__rule


class ParameterFile:
    """
    A file of parameters.

    Parameters
    ----------
    param_file
        The path.
    allow_substs
        Whether substitutions in the file, such as `$(var name)`, are performed.

    Raises
    ------
    TypeError
        An argument has the wrong type.

    """

    def __init__(self, param_file: SomeSubstitutionsType, *, allow_substs: bool = False) -> None:
        ensure_argument_type(
            param_file, SomeSubstitutionsType_types_tuple, 'param_file', 'ParameterFile'
        )
        ensure_argument_type(allow_substs, bool, 'allow_substs', 'ParameterFile')
        self.__param_file = normalize_to_list_of_substitutions(param_file)
        self.__allow_substs = allow_substs

    @property
    def param_file(self) -> list[Substitution]:
        """Return the path, as substitutions."""
        return self.__param_file

    @property
    def allow_substs(self) -> bool:
        """Whether substitutions in the file are performed."""
        return self.__allow_substs

    def evaluate(self, context: LaunchContext) -> str:
        """
        Evaluate the path of the file, or of a temporary copy with substitutions performed.

        Parameters
        ----------
        context
            The launch context used to perform substitutions in the path and in the file.

        Raises
        ------
        ValueError
            The copy is not valid YAML.

        """
        path = os.fspath(perform_substitutions(context, self.__param_file))
        if self.__allow_substs and os.path.isfile(path):
            from launch_ros.utilities.parameter_files import substitute_parameter_file

            return substitute_parameter_file(context, path)
        return path
