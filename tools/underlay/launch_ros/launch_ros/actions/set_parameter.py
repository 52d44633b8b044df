# SPDX-License-Identifier: Apache-2.0
"""Launch action that sets a global parameter."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.some_substitutions_type import SomeSubstitutionsType
from launch_ros.utilities.parameters_and_remappings import (
    evaluate_parameter_dict,
    normalize_parameter_dict,
)

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser


class SetParameter(Action):
    """
    Sets a parameter of the nodes that follow, to the end of the group that it is in.

    Parameters
    ----------
    name
        The name of the parameter.
    value
        A scalar, a list, a ParameterValue, or substitutions, whose result is typed by YAML
        rules.
    **kwargs
        As for `Action`: `condition`.

    Raises
    ------
    TypeError
        The value is not a valid parameter value.

    """

    def __init__(self, name: SomeSubstitutionsType, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        key: Any = name if isinstance(name, (str, tuple, list)) else (name,)
        key = tuple(key) if isinstance(key, list) else key
        self.__parameter = normalize_parameter_dict({key: value})

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Parse an element of a launch file into the class and its keyword arguments.

        Parameters
        ----------
        entity
            The `set_parameter` element, with the attributes `name` and `value`.
        parser
            Parses substitutions in its attributes.

        Returns
        -------
        tuple
            The class and the keyword arguments of its constructor.

        """
        from launch_ros.utilities.parse_parameters import parse_value

        _, kwargs = super().parse(entity, parser)
        kwargs['name'] = parser.parse_substitution(entity.get_attr('name'))
        kwargs['value'] = parse_value(entity, parser)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """
        Set the parameter for the nodes that follow in this scope.

        The list of parameters is replaced, not modified in place, so that the end of the scope
        restores it.

        Parameters
        ----------
        context
            The launch context; its configuration `global_params` holds the global parameters.

        Raises
        ------
        TypeError
            The substituted value is not a valid parameter value.

        """
        known = context.launch_configurations.get('global_params', [])
        added = evaluate_parameter_dict(context, self.__parameter)
        context.launch_configurations['global_params'] = [*known, *added.items()]
        context.run.note(parameters=added)
