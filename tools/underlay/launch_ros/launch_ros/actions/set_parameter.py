# SPDX-License-Identifier: Apache-2.0
"""The action that sets a parameter of all nodes."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.some_substitutions_type import SomeSubstitutionsType
from launch_ros.utilities.evaluate_parameters_impl import evaluate_parameter_dict
from launch_ros.utilities.normalize_parameters_impl import normalize_parameter_dict

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser


class SetParameter(Action):
    """Sets a parameter of the nodes that follow, to the end of the group that it is in."""

    def __init__(self, name: SomeSubstitutionsType, value: Any, **kwargs: Any) -> None:
        """Create the action."""
        super().__init__(**kwargs)
        key: Any = name if isinstance(name, (str, tuple, list)) else (name,)
        key = tuple(key) if isinstance(key, list) else key
        self.__parameter = normalize_parameter_dict({key: value})

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return the class, and what to construct it with, for an element of a launch file."""
        from launch_ros.utilities.parse_parameters import parse_value

        _, kwargs = super().parse(entity, parser)
        kwargs['name'] = parser.parse_substitution(entity.get_attr('name'))
        kwargs['value'] = parse_value(entity, parser)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """Set it; the list is not changed in place, so that the end of the scope undoes it."""
        known = context.launch_configurations.get('global_params', [])
        added = evaluate_parameter_dict(context, self.__parameter)
        context.launch_configurations['global_params'] = [*known, *added.items()]
        if context._observer is not None:
            context._observer.note(parameters=added)
