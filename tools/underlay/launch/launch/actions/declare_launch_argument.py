# SPDX-License-Identifier: Apache-2.0
"""The action that declares an argument of a launch file."""

from __future__ import annotations

from collections.abc import Container, Iterable
import os
from typing import Any, NoReturn, Optional, TYPE_CHECKING

from launch.action import Action
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import perform_substitutions
from launch.utilities.arguments import list_like, of_type, optional_text_like

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext


class DeclareLaunchArgument(Action):
    """
    Action that declares a launch argument: a launch configuration that the user may set.

    Parameters
    ----------
    name
        The name of the argument.
    default_value
        The value if the user sets none; None if the argument must be given.
    description
        The description for the user.
    choices
        The allowed values; None if all are allowed.
    **kwargs
        Keyword arguments of `Action`.

    Raises
    ------
    TypeError
        An argument has the wrong type; the error names it.
    RuntimeError
        `choices` is empty, or the default is not one of them.

    Attributes
    ----------
    is_conditional
        Whether a condition decides on the declaration, which a description finds out when it
        lists its arguments.

    """

    declares_argument = True

    def __init__(
        self,
        name: str,
        *,
        default_value: Optional[SomeSubstitutionsType] = None,
        description: Optional[str] = None,
        choices: Optional[Iterable[str]] = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.is_conditional = False
        of_type('name', name, (str,), 'a string')
        if description is not None:
            of_type('description', description, (str,), 'a string')
        if choices is not None and not hasattr(choices, '__contains__'):
            choices = list_like('choices', choices, 'strings')
        self.__name = name
        self.__choices: Any = choices
        self.__description = _describe(description, choices)
        self.__default_value = optional_text_like('default_value', default_value)
        self._check_choices(default_value)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Read `name`, `default`, `description` and the children `choice` of the element `arg`.

        Parameters
        ----------
        entity, parser
            As for `Action.parse`.

        Returns
        -------
        tuple
            The class, and the keyword arguments for its constructor.

        """
        from launch.frontend.attributes import children_named

        _, kwargs = super().parse(entity, parser)
        kwargs['name'] = parser.escape_characters(entity.get_attr('name'))
        default = entity.get_attr('default', optional=True)
        if default is not None:
            kwargs['default_value'] = parser.parse_substitution(default)
        description = entity.get_attr('description', optional=True)
        if description is not None:
            kwargs['description'] = parser.escape_characters(description)
        choices = children_named(entity, 'choice')
        if choices:
            kwargs['choices'] = [_parse_choice(choice, parser) for choice in choices]
        return cls, kwargs

    def _check_choices(self, default_value: Any) -> None:
        if self.__choices is None:
            return
        if not list(self.__choices):
            _fail(
                f'The argument "{self.__name}" has an empty list of choices; give at least one '
                'value, or leave the choices out.'
            )
        plain = isinstance(default_value, (str, os.PathLike))
        if plain and os.fspath(default_value) not in self.__choices:
            _fail(
                f'Provided default_value "{default_value}" is not in provided choices '
                f'"{self.__choices}".'
            )

    @property
    def name(self) -> str:
        """Return the name of the argument."""
        return self.__name

    @property
    def default_value(self) -> Optional[list[Substitution]]:
        """Return the default as a list of substitutions, or None if the argument must be given."""
        return self.__default_value

    @property
    def description(self) -> str:
        """Return the description of the argument."""
        return self.__description

    @property
    def choices(self) -> Optional[Container[str]]:
        """Return the allowed values, or None if all are allowed."""
        choices: Optional[Container[str]] = self.__choices
        return choices

    def outline(self) -> dict[str, Any]:
        """Return the name of the argument."""
        return {'name': self.__name}

    def execute(self, context: LaunchContext) -> None:
        """
        Set the launch configuration to the default unless it is set; check its value.

        Parameters
        ----------
        context
            The launch context, in which the default is performed.

        Raises
        ------
        RuntimeError
            The argument has no value, or it is not one of the choices.

        """
        context.launch_configurations.declared.add(self.__name)
        is_given = self.__name in context.launch_configurations
        if not is_given:
            if self.__default_value is None:
                _fail(
                    f'Required launch argument "{self.__name}" (description: '
                    f'"{self.__description}") was not provided'
                )
            context.launch_configurations[self.__name] = perform_substitutions(
                context, self.__default_value
            )
        value = context.launch_configurations[self.__name]
        context.run.note(name=self.__name, value=value, is_default=not is_given)
        if self.__choices is not None and value not in self.__choices:
            from ros_environment.suggestions import did_you_mean

            hint = did_you_mean(value, [str(choice) for choice in self.__choices])
            _fail(
                f'Argument "{self.__name}" provided value "{value}" is not valid. '
                f'Valid options are: {self.__choices}{hint and f". {hint}"}'
            )


def _describe(description: Optional[str], choices: Optional[Iterable[str]]) -> str:
    """Format the description with the choices."""
    if choices is None:
        return 'no description given' if description is None else description
    if description is None:
        return f'One of: {choices}'
    stop = '' if description.endswith('.') else '.'
    return f'{description}{stop} Valid choices are: {choices}'


def _parse_choice(entity: Entity, parser: Parser) -> str:
    value = parser.escape_characters(entity.get_attr('value'))
    entity.assert_entity_completely_parsed()
    return value


def _fail(text: str) -> NoReturn:
    from launch.logging import get_logger

    get_logger('launch.actions.declare_launch_argument').error('%s', text)
    raise RuntimeError(text)
