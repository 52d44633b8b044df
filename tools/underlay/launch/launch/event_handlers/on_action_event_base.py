# SPDX-License-Identifier: Apache-2.0
"""The handlers of events that belong to an action: their base class, and that of completion."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, Optional, TYPE_CHECKING, Union

from launch.event import Event
from launch.event_handler import BaseEventHandler
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.some_entities_type import SomeEntitiesType

if TYPE_CHECKING:
    from launch.action import Action
    from launch.launch_context import LaunchContext

Reaction = Union[SomeEntitiesType, Callable[..., Optional[SomeEntitiesType]]]


class OnActionEventBase(BaseEventHandler):
    """
    Base class of handlers of one class of events, of one action, of some, or of all.

    Parameters
    ----------
    action_matcher
        An action, a predicate that accepts actions, or None for all.
    on_event
        The entities that are visited, or a function of the event and the context that returns
        them.
    target_event_cls
        The class of the events.
    target_action_cls
        The class of the actions that the events belong to.
    **kwargs
        Keyword arguments of `BaseEventHandler`, such as `handle_once`.

    Raises
    ------
    TypeError
        The matcher or the reaction has the wrong type.

    """

    def __init__(
        self,
        *,
        action_matcher: Optional[Union[Callable[[Any], bool], LaunchDescriptionEntity]],
        on_event: Reaction,
        target_event_cls: type[Any],
        target_action_cls: type[LaunchDescriptionEntity],
        **kwargs: Any,
    ) -> None:
        if not (
            action_matcher is None
            or isinstance(action_matcher, target_action_cls)
            or callable(action_matcher)
        ):
            raise TypeError(
                f'expected the target_action of {type(self).__name__} to be a '
                f"'{target_action_cls.__name__}', a callable or None, "
                f"but got '{action_matcher!r}'"
            )
        self.__action_matcher = action_matcher
        self.__target_event_cls = target_event_cls
        reaction, self.__actions_on_event = checked_reaction(on_event, type(self).__name__)
        self.__on_event = reaction or self.__actions_on_event
        super().__init__(matcher=self._is_meant, **kwargs)

    @property
    def matcher_description(self) -> str:
        """Return a human-readable description of the accepted events."""
        event = self.__target_event_cls.__name__
        return f'event == {event} and event.action == {self.__action_matcher}'

    def describe(self) -> tuple[str, list[Any]]:
        """Return a short human-readable description, and the entities that are visited."""
        return super().describe()[0], list(self.__actions_on_event)

    def describe_event(self) -> str:
        """Return a description of the event that the handler waits for."""
        return f'{self.__target_event_cls.__name__} of {target_in_words(self.__action_matcher)}'

    def _is_meant(self, event: Event) -> bool:
        """Check whether the event belongs to the target."""
        if not isinstance(event, self.__target_event_cls):
            return False
        if self.__action_matcher is None or event.action is self.__action_matcher:
            return True
        if isinstance(self.__action_matcher, LaunchDescriptionEntity):
            return False
        return bool(self.__action_matcher(event.action))

    def handle(self, event: Event, context: LaunchContext) -> Optional[SomeEntitiesType]:
        """
        Return the entities of the reaction, which are visited next.

        Parameters
        ----------
        event, context
            As for `BaseEventHandler.handle`; a reaction that is a function is called with both.

        """
        super().handle(event, context)
        if callable(self.__on_event):
            return self.__on_event(event, context)
        return self.__actions_on_event


def target_in_words(target: Any) -> str:
    """
    Describe the target whose events a handler waits for.

    Parameters
    ----------
    target
        An action, a predicate, or None for all actions.

    """
    if target is None:
        return 'any action'
    name = getattr(target, 'name', None)
    return f"'{name}'" if isinstance(name, str) else type(target).__name__


def checked_reaction(
    reaction: Any,
    owner: str,
) -> tuple[
    Optional[Callable[..., Optional[SomeEntitiesType]]],
    list[LaunchDescriptionEntity],
]:
    """
    Split the reaction to an event into a function or a list of entities.

    Parameters
    ----------
    reaction
        An entity, an iterable of entities, or a function that returns such.
    owner
        The class that was given the reaction, for the error.

    Returns
    -------
    tuple
        The function and an empty list, or None and the entities.

    Raises
    ------
    TypeError
        The reaction is none of these.

    """
    if isinstance(reaction, LaunchDescriptionEntity):
        return None, [reaction]
    if callable(reaction):
        return reaction, []
    entities = list(reaction) if isinstance(reaction, Iterable) else [reaction]
    for entity in entities:
        if not isinstance(entity, LaunchDescriptionEntity):
            raise TypeError(
                f'expected {owner} to be given an action, a list of actions or a callable, '
                f"but got '{entity!r}' of type '{type(entity).__name__}'"
            )
    return None, entities


class OnExecutionComplete(OnActionEventBase):
    """
    Event handler that reacts when the execution of an action is complete.

    Parameters
    ----------
    target_action
        An action, a predicate that accepts actions, or None for all.
    on_completion
        The entities that are visited, or a function of the event and the context that returns
        them.
    **kwargs
        Keyword arguments of `BaseEventHandler`, such as `handle_once`.

    Raises
    ------
    TypeError
        The target or the reaction has the wrong type.

    """

    def __init__(
        self,
        *,
        target_action: Optional[Union[Callable[[Any], bool], Action]] = None,
        on_completion: Reaction,
        **kwargs: Any,
    ) -> None:
        from launch.action import Action
        from launch.events import ExecutionComplete

        super().__init__(
            action_matcher=target_action,
            on_event=on_completion,
            target_event_cls=ExecutionComplete,
            target_action_cls=Action,
            **kwargs,
        )
