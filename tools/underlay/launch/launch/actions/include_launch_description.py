# SPDX-License-Identifier: Apache-2.0
"""The action that includes a launch file."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
import os
from typing import Any, Optional, TYPE_CHECKING, Union

from launch._include_stack import enter_launch_file, missing_launch_file, open_file
from launch.action import Action
from launch.actions.launch_configurations import SetLaunchConfiguration
from launch.launch_description import DeclaredArgument, Inclusion, LaunchDescription
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.launch_description_source import LaunchDescriptionSource
from launch.substitution import SomeSubstitutionsType
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.arguments import list_like, text_like

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext

Arguments = Iterable[tuple[SomeSubstitutionsType, SomeSubstitutionsType]]


class IncludeLaunchDescription(Action):
    """
    Action that includes a launch file, with some launch arguments.

    Parameters
    ----------
    launch_description_source
        The source, or the path of a launch file in any format.
    launch_arguments
        Pairs of a name and a value, which are set before the file is visited.
    **kwargs
        Keyword arguments of `Action`.

    Raises
    ------
    TypeError
        An argument has the wrong type; the error names it.

    """

    includes_file = True

    def __init__(
        self,
        launch_description_source: Union[LaunchDescriptionSource, SomeSubstitutionsType],
        *,
        launch_arguments: Optional[Arguments] = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        if not isinstance(launch_description_source, LaunchDescriptionSource):
            from launch.launch_description_sources.launch_files import (
                AnyLaunchDescriptionSource,
            )

            path = text_like('launch_description_source', launch_description_source)
            launch_description_source = AnyLaunchDescriptionSource(path)
        self.__launch_description_source = launch_description_source
        self.__launch_arguments = () if launch_arguments is None else _pairs(launch_arguments)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Read `file` and the children `arg` and `let` of the element `include`.

        Parameters
        ----------
        entity, parser
            As for `Action.parse`.

        Returns
        -------
        tuple
            The class, and the keyword arguments for its constructor.

        """
        from launch.frontend.attributes import parse_pairs

        _, kwargs = super().parse(entity, parser)
        path = parser.parse_substitution(entity.get_attr('file'))
        kwargs['launch_description_source'] = path
        kwargs['launch_arguments'] = parse_pairs(entity, parser, 'arg', 'let')
        return cls, kwargs

    @property
    def launch_description_source(self) -> LaunchDescriptionSource:
        """Return the source."""
        return self.__launch_description_source

    @property
    def launch_arguments(
        self,
    ) -> tuple[tuple[SomeSubstitutionsType, SomeSubstitutionsType], ...]:
        """Return the launch arguments."""
        return self.__launch_arguments

    def describe(self) -> str:
        """Return a short human-readable description."""
        return f'IncludeLaunchDescription({self.__launch_description_source.location})'

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the launch description if it can be loaded without a context."""
        description = self.__launch_description_source.try_get_launch_description_without_context()
        return [] if description is None else [description]

    def check_in_advance(self, context: LaunchContext) -> None:
        """
        Raise an error if the file is already known and does not exist.

        Parameters
        ----------
        context
            The launch context.

        Raises
        ------
        FileNotFoundError
            The file does not exist.

        """
        from launch.preflight import constant_text

        path = constant_text(self.__launch_description_source.location_parts, context)
        if path is not None and os.path.dirname(path) and not os.path.isfile(path):
            raise missing_launch_file(context, path)

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """
        Load the launch file and make it the current one.

        Parameters
        ----------
        context
            The launch context, in which the path is performed.

        Returns
        -------
        list of LaunchDescriptionEntity
            The actions that set the arguments, the description, and the end of the include, which
            are visited next.

        Raises
        ------
        FileNotFoundError
            The file does not exist.
        CircularIncludeError
            The file includes itself endlessly.
        RuntimeError
            The file declares an argument that has no default and is not given.

        """
        path = os.path.abspath(self.__launch_description_source.expand_location(context))
        file = open_file(context, path, self.call_site)
        description = self.__launch_description_source.get_launch_description(context)
        leave = enter_launch_file(context, file)
        self._check_required(description, context)
        context.run.note(path=path)
        arguments = [_setting(name, value) for name, value in self.__launch_arguments]
        return [*arguments, description, leave]

    def _get_launch_file(self) -> str:
        """Return the path of the file as far as it is known; public code uses this method."""
        source = self.__launch_description_source
        return os.path.abspath(source.location_in_advance() or source.location)

    def given_names(self, context: Optional[LaunchContext] = None) -> list[str]:
        """
        List the names of the launch arguments that are given here.

        Parameters
        ----------
        context
            The context in which names are performed; without one, unknown names are empty.

        """
        return [_text(name, context) for name, _ in self.__launch_arguments]

    def outline(self) -> dict[str, Any]:
        """Return the location of the file."""
        return {'path': self.__launch_description_source.location}

    def _check_required(self, description: LaunchDescription, context: LaunchContext) -> None:
        """Raise an error if an argument without a default is not given."""
        given = self.given_names(context)
        found = description.get_launch_arguments_with_include_launch_description_actions()
        for argument, includes in found:
            if argument.is_conditional or argument.default_value is not None:
                continue
            names = [*given, *(name for each in includes for name in each.given_names())]
            if argument.name not in names:
                error = RuntimeError(
                    f"Included launch description missing required argument '{argument.name}' "
                    f"(description: '{argument.description}'), given: [{', '.join(names)}]"
                )
                self._note_lines(error, argument, includes)
                raise error

    def _note_lines(
        self,
        error: RuntimeError,
        argument: DeclaredArgument,
        includes: list[Inclusion],
    ) -> None:
        """Record the line of the innermost include, which must pass the missing argument."""
        from launch.failures import note_line

        way: list[Inclusion] = [self, *includes]
        lines = [each.call_site for each in reversed(way) if each.call_site]
        if lines:
            note_line(error, lines[0], type(self).__name__, tuple(lines[1:]))
        else:
            note_line(error, argument.call_site)


def _pairs(launch_arguments: Any) -> tuple[tuple[Any, Any], ...]:
    """Validate the launch arguments, which must be pairs of a name and a value."""
    if isinstance(launch_arguments, Mapping):
        raise TypeError(
            "the argument 'launch_arguments' must be a list of pairs, but it is a dictionary: "
            'append .items() to it'
        )
    pairs = tuple(list_like('launch_arguments', launch_arguments, 'pairs of a name and a value'))
    for pair in pairs:
        if isinstance(pair, str) or not isinstance(pair, Sequence) or len(pair) != 2:
            raise TypeError(
                "the argument 'launch_arguments' must be a list of pairs of a name and a value, "
                f'but one item is {pair!r}'
            )
    return pairs


def _setting(name: Any, value: Any) -> SetLaunchConfiguration:
    """Return the action that sets a launch argument."""
    return SetLaunchConfiguration(name, text_like(f'launch_arguments[{name!r}]', value))


def _text(name: SomeSubstitutionsType, context: Optional[LaunchContext]) -> str:
    """Return the name of an argument; without a context, as far as it is known."""
    from launch.launch_context import LaunchContext
    from launch.substitution import SubstitutionFailure

    try:
        return perform_substitutions(
            context or LaunchContext(), normalize_to_list_of_substitutions(name)
        )
    except SubstitutionFailure:
        if context is not None:
            raise
        return ''
