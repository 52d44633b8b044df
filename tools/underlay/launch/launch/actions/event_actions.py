# SPDX-License-Identifier: Apache-2.0
"""The actions that emit events, such as the shutdown, and that register event handlers."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, TYPE_CHECKING

from launch.action import Action
from launch.event import Event
from launch.event_handler import BaseEventHandler
from launch.events import Shutdown as ShutdownEvent
from launch.events.process import ProcessExited
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.substitution import SomeSubstitutionsType
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext


class EmitEvent(Action):
    """
    Action that emits an event, which is handled when all that is being visited is done.

    Parameters
    ----------
    event
        The event.
    **kwargs
        Keyword arguments of `Action`.

    Raises
    ------
    RuntimeError
        `event` is not an `Event`.

    """

    def __init__(self, *, event: Event, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        if not isinstance(event, Event):
            raise RuntimeError(
                f"EmitEvent expected an event, but got '{event!r}' of type "
                f"'{type(event).__name__}'"
            )
        self.__event = event

    @property
    def event(self) -> Event:
        """Return the event."""
        return self.__event

    def execute(self, context: LaunchContext) -> None:
        """
        Queue the event.

        Parameters
        ----------
        context
            The launch context, with the queue.

        """
        context.emit_event_sync(self.__event)
        if context.run.observer is not None:
            context.run.observer.note(**self.outline())

    def outline(self) -> dict[str, Any]:
        """Return the facts about the event."""
        return self.__event.outline()


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


class RegisterEventHandler(Action):
    """
    Action that registers an event handler.

    Parameters
    ----------
    event_handler
        The handler.
    **kwargs
        Keyword arguments of `Action`.

    """

    def __init__(self, event_handler: BaseEventHandler, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__event_handler = event_handler

    @property
    def event_handler(self) -> BaseEventHandler:
        """Return the handler."""
        return self.__event_handler

    def execute(self, context: LaunchContext) -> None:
        """
        Register the handler before all others.

        Parameters
        ----------
        context
            The launch context.

        """
        context.register_event_handler(self.__event_handler)
        if context.run.observer is not None:
            for event, entities in self.outline_of_waiting():
                context.run.observer.note_waiting(event, entities)

    def outline_of_waiting(self) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return the entities of the handler, with the event that they wait for."""
        return [(self.__event_handler.describe_event(), self.__event_handler.describe()[1])]

    def describe_conditional_sub_entities(
        self,
    ) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return the entities of the handler, which wait for an event."""
        text, entities = self.__event_handler.describe()
        return [(text, entities)] if entities else []


class UnregisterEventHandler(Action):
    """
    Action that removes an event handler.

    Parameters
    ----------
    event_handler
        The handler, which must be registered when the action is executed.
    **kwargs
        Keyword arguments of `Action`.

    """

    def __init__(self, event_handler: BaseEventHandler, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__event_handler = event_handler

    @property
    def event_handler(self) -> BaseEventHandler:
        """Return the handler."""
        return self.__event_handler

    def execute(self, context: LaunchContext) -> None:
        """
        Unregister the handler.

        Parameters
        ----------
        context
            The launch context.

        Raises
        ------
        ValueError
            The handler is not registered.

        """
        context.unregister_event_handler(self.__event_handler)
