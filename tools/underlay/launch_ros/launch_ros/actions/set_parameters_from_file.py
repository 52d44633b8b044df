# SPDX-License-Identifier: Apache-2.0
"""The action that sets parameters of all nodes from a file."""

from __future__ import annotations

import os
from typing import Any, TYPE_CHECKING

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.some_substitutions_type import SomeSubstitutionsType
from launch.utilities.normalize_to_list_of_substitutions_impl import (
    normalize_to_list_of_substitutions,
)
from launch.utilities.perform_substitutions_impl import perform_substitutions

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser


class SetParametersFromFile(Action):
    """Gives a parameter file to the nodes that follow, to the end of the group that it is in."""

    def __init__(self, filename: SomeSubstitutionsType, **kwargs: Any) -> None:
        """Create the action."""
        super().__init__(**kwargs)
        self.__filename = normalize_to_list_of_substitutions(filename)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return the class, and what to construct it with, for an element of a launch file."""
        _, kwargs = super().parse(entity, parser)
        kwargs['filename'] = parser.parse_substitution(entity.get_attr('filename'))
        return cls, kwargs

    def _check_in_advance(self, context: LaunchContext) -> None:
        from launch._preflight import constant_text

        path = constant_text(self.__filename, context)
        if path is not None:
            _require(os.path.abspath(path))

    def execute(self, context: LaunchContext) -> None:
        """Set them."""
        path = os.path.abspath(perform_substitutions(context, self.__filename))
        _require(path)
        known = context.launch_configurations.get('global_params', [])
        context.launch_configurations['global_params'] = [*known, path]
        if context._observer is not None:
            context._observer.note(path=path)


def _require(path: str) -> None:
    """Raise an error if a parameter file is not there."""
    if not os.path.isfile(path):
        from launch._missing_file import explain_missing_file

        raise FileNotFoundError(explain_missing_file('parameter file', path))
