# SPDX-License-Identifier: Apache-2.0
"""The action that logs a string."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from launch.action import Action
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext


class LogInfo(Action):
    """
    Action that logs a text for the user.

    Parameters
    ----------
    msg
        The text.
    **kwargs
        Keyword arguments of `Action`.

    """

    def __init__(self, *, msg: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__msg = normalize_to_list_of_substitutions(msg)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Read `message` of the element `log`.

        Parameters
        ----------
        entity, parser
            As for `Action.parse`.

        Returns
        -------
        tuple
            The class, and the keyword arguments for its constructor.

        """
        _, kwargs = super().parse(entity, parser)
        kwargs['msg'] = parser.parse_substitution(entity.get_attr('message'))
        return cls, kwargs

    @property
    def msg(self) -> list[Substitution]:
        """Return the text as a list of substitutions."""
        return self.__msg

    def outline(self) -> dict[str, Any]:
        """Return the description of the text."""
        return {'text': ' + '.join(part.describe() for part in self.__msg)}

    def execute(self, context: LaunchContext) -> None:
        """
        Log the text with the logger `launch.user`.

        Parameters
        ----------
        context
            The launch context, in which the text is performed.

        """
        from launch.logging import get_logger

        text = perform_substitutions(context, self.__msg)
        get_logger('launch.user').info('%s', text)
        context.run.note(text=text)
