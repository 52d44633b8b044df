# SPDX-License-Identifier: Apache-2.0
"""The actions that register and unregister an event handler."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, TYPE_CHECKING

from launch.action import Action
from launch.event_handler import BaseEventHandler
from launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


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
