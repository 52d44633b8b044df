# SPDX-License-Identifier: Apache-2.0
"""The base classes of all event handlers."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, Optional, TYPE_CHECKING

from launch.launch_description_entity import LaunchDescriptionEntity
from launch.some_entities_type import SomeEntitiesType

if TYPE_CHECKING:
    from launch.event import Event
    from launch.failures import OpenFile
    from launch.launch_context import LaunchContext


class BaseEventHandler:
    """
    Base class of event handlers.

    Parameters
    ----------
    matcher
        Called with an event; returns whether the handler reacts to it.
    handle_once
        Whether the handler unregisters itself when it handles an event.

    Attributes
    ----------
    include_stack
        The launch files that were being read when the handler was registered.

    """

    include_stack: tuple[OpenFile, ...] = ()

    def __init__(self, *, matcher: Callable[[Any], bool], handle_once: bool = False) -> None:
        self.__matcher = matcher
        self.__handle_once = handle_once

    @property
    def handle_once(self) -> bool:
        """Whether the handler reacts only once."""
        return self.__handle_once

    @property
    def handler_description(self) -> str:
        """Return a human-readable description of the handler."""
        return ''

    @property
    def matcher_description(self) -> str:
        """Return a human-readable description of the accepted events."""
        return getattr(self.__matcher, '__name__', repr(self.__matcher))

    def describe_event(self) -> str:
        """Return a description of the event that the handler waits for."""
        return f'an event ({type(self).__name__})'

    def matches(self, event: Event) -> bool:
        """
        Whether the handler reacts to an event.

        Parameters
        ----------
        event
            The event that was emitted, or may be.

        """
        return self.__matcher(event)

    def describe(self) -> tuple[str, list[Any]]:
        """Return a short human-readable description, and the entities that are visited."""
        return f"{type(self).__name__}(matcher='{self.matcher_description}')", []

    def handle(self, event: Event, context: LaunchContext) -> Optional[SomeEntitiesType]:
        """
        Add the event to the local variables of the context; subclasses react to it.

        Parameters
        ----------
        event
            The event that has happened, which `matches` accepts.
        context
            The launch context, in which the local variable `event` is set.

        Returns
        -------
        SomeEntitiesType or None
            The entities that are visited next; None here.

        """
        context.extend_locals({'event': event})
        if self.__handle_once:
            context.unregister_event_handler(self)
        return None


class EventHandler(BaseEventHandler):
    """
    Event handler that visits entities when an event happens.

    Parameters
    ----------
    matcher
        Called with an event; returns whether the handler reacts to it.
    entities
        The entities to visit on each event; an iterable is converted to a list.
    handle_once
        Whether the handler unregisters itself when it handles an event.

    """

    def __init__(
        self,
        *,
        matcher: Callable[[Any], bool],
        entities: Optional[SomeEntitiesType] = None,
        handle_once: bool = False,
    ) -> None:
        super().__init__(matcher=matcher, handle_once=handle_once)
        if entities is None or isinstance(entities, LaunchDescriptionEntity):
            self.__entities: Iterable[LaunchDescriptionEntity] = (
                [] if entities is None else [entities]
            )
        else:
            self.__entities = list(entities)  # they are inspected before they are visited

    @property
    def entities(self) -> Iterable[LaunchDescriptionEntity]:
        """Return the entities that are visited."""
        return self.__entities

    def describe(self) -> tuple[str, list[Any]]:
        """Return a short human-readable description, and the entities that are visited."""
        return super().describe()[0], list(self.__entities)

    def handle(self, event: Event, context: LaunchContext) -> Optional[SomeEntitiesType]:
        """
        Return the entities, which are visited next.

        Parameters
        ----------
        event, context
            As for `BaseEventHandler.handle`.

        """
        super().handle(event, context)
        return self.__entities
