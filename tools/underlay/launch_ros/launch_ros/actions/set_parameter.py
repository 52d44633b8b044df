# SPDX-License-Identifier: Apache-2.0
"""The action that sets a parameter of all nodes."""

from __future__ import annotations

from typing import Any

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.some_substitutions_type import SomeSubstitutionsType
from launch_ros.utilities.evaluate_parameters_impl import evaluate_parameter_dict
from launch_ros.utilities.normalize_parameters_impl import normalize_parameter_dict


class SetParameter(Action):
    """Sets a parameter of the nodes that follow, to the end of the group that it is in."""

    def __init__(self, name: SomeSubstitutionsType, value: Any, **kwargs: Any) -> None:
        """Create the action."""
        super().__init__(**kwargs)
        key: Any = name if isinstance(name, (str, tuple, list)) else (name,)
        key = tuple(key) if isinstance(key, list) else key
        self.__parameter = normalize_parameter_dict({key: value})

    def execute(self, context: LaunchContext) -> None:
        """Set it; the list is not changed in place, so that the end of the scope undoes it."""
        known = context.launch_configurations.get('global_params', [])
        added = evaluate_parameter_dict(context, self.__parameter)
        context.launch_configurations['global_params'] = [*known, *added.items()]
        if context._observer is not None:
            context._observer.note(parameters=added)
