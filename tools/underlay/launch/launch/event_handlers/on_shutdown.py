# SPDX-License-Identifier: Apache-2.0
"""Event handler for the shutdown of the launch."""

from __future__ import annotations

from typing import Any, Optional, TYPE_CHECKING

from launch.event_handler import BaseEventHandler
from launch.event_handlers.on_action_event_base import checked_reaction, Reaction
from launch.events import Shutdown
from launch.some_entities_type import SomeEntitiesType

if TYPE_CHECKING:
    from launch.event import Event
    from launch.launch_context import LaunchContext


class OnShutdown(BaseEventHandler):
    """
    Event handler that reacts when the launch shuts down, for whatever reason.

    Parameters
    ----------
    on_shutdown
        The entities that are visited, or a function of the event and the context that returns
        them.
    **kwargs
        Keyword arguments of `BaseEventHandler`, such as `handle_once`.

    Raises
    ------
    TypeError
        The reaction has the wrong type.

    """

    def __init__(self, *, on_shutdown: Reaction, **kwargs: Any) -> None:
        super().__init__(matcher=lambda event: isinstance(event, Shutdown), **kwargs)
        self.__reaction, self.__entities = checked_reaction(on_shutdown, type(self).__name__)

    @property
    def matcher_description(self) -> str:
        """Return a human-readable description of the accepted events."""
        return 'event is Shutdown'

    def describe_event(self) -> str:
        """Return a description of the event that the handler waits for."""
        return 'the shutdown'

    def describe(self) -> tuple[str, list[Any]]:
        """Return a short human-readable description, and the entities that are visited."""
        return super().describe()[0], list(self.__entities)

    def handle(self, event: Event, context: LaunchContext) -> Optional[SomeEntitiesType]:
        """
        Return the entities of the reaction, which are visited next.

        Parameters
        ----------
        event, context
            As for `BaseEventHandler.handle`; a reaction that is a function is called with both.

        """
        super().handle(event, context)
        if self.__reaction is not None:
            return self.__reaction(event, context)
        return self.__entities
