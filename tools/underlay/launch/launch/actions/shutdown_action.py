# SPDX-License-Identifier: Apache-2.0
"""The action that ends the launch."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from launch.action import Action
from launch.events import Shutdown as ShutdownEvent
from launch.events.process import ProcessExited
from launch.some_substitutions_type import SomeSubstitutionsType
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext


class Shutdown(Action):
    """
    Action that ends the launch; as the `on_exit` of a process, it makes that process required.

    Parameters
    ----------
    reason
        The reason for the shutdown, for the user.
    **kwargs
        Keyword arguments of `Action`.

    """

    def __init__(
        self,
        *,
        reason: SomeSubstitutionsType = 'reason not given',
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.__reason = normalize_to_list_of_substitutions(reason)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Read `reason` of the element `shutdown`.

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
        reason = entity.get_attr('reason', optional=True)
        if reason is not None:
            kwargs['reason'] = parser.parse_substitution(reason)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """
        Queue the shutdown event.

        Parameters
        ----------
        context
            The launch context, in which the reason is performed.

        """
        event = context.get_locals_as_dict().get('event')
        if isinstance(event, ProcessExited):
            from launch.logging import get_logger

            get_logger('launch').info(
                'process[%s] was required: shutting down launched system', event.process_name
            )
        reason = perform_substitutions(context, self.__reason)
        context.emit_event_sync(ShutdownEvent(reason=reason))
        context.run.note(reason=reason)
