# SPDX-License-Identifier: Apache-2.0
"""Event handler for lifecycle transitions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Optional, TYPE_CHECKING

from launch.event_handler import EventHandler
from launch.event_handlers.on_action_event_base import target_in_words
from launch.some_entities_type import SomeEntitiesType
from launch_ros.events.lifecycle import StateTransition

if TYPE_CHECKING:
    from launch_ros.actions.lifecycle_node import LifecycleNode

_STATES = (
    'unknown',
    'unconfigured',
    'inactive',
    'active',
    'finalized',
    'configuring',
    'cleaningup',
    'shuttingdown',
    'activating',
    'deactivating',
    'errorprocessing',
)


class OnStateTransition(EventHandler):
    """
    Reacts when a lifecycle node has changed its state; criteria left out match anything.

    Parameters
    ----------
    entities
        The entities to visit.
    target_lifecycle_node
        The action that runs the node.
    transition
        The label of the transition, such as `configure`.
    start_state, goal_state
        The labels of the previous and the new state, such as `configuring` and `inactive`.
    matcher
        Predicate of events, instead of all other criteria.
    **kwargs
        As for `EventHandler`: `handle_once`.

    Raises
    ------
    ValueError
        A matcher is given together with other criteria.

    """

    def __init__(
        self,
        *,
        entities: SomeEntitiesType,
        target_lifecycle_node: Optional[LifecycleNode] = None,
        transition: Optional[str] = None,
        start_state: Optional[str] = None,
        goal_state: Optional[str] = None,
        matcher: Optional[Callable[[Any], bool]] = None,
        **kwargs: Any,
    ) -> None:
        wanted = {'transition': transition, 'start_state': start_state, 'goal_state': goal_state}
        self.__wanted = {name: value for name, value in wanted.items() if value is not None}
        self.__target = target_lifecycle_node
        if matcher is not None and (self.__wanted or target_lifecycle_node is not None):
            raise ValueError(
                'OnStateTransition takes either a matcher or what is to be matched, not both'
            )
        _warn_of_unknown_states(start_state, goal_state)
        super().__init__(matcher=matcher or self._is_meant, entities=entities, **kwargs)

    @property
    def matcher_description(self) -> str:
        """Return a human-readable description of the accepted events."""
        conditions = [f"event.{name} == '{value}'" for name, value in self.__wanted.items()]
        if self.__target is not None:
            conditions.insert(0, f'event.action == {self.__target}')
        return ' and '.join(['event is StateTransition', *conditions])

    def describe_event(self) -> str:
        """Return a description of the event that the handler waits for."""
        wanted = ''.join(
            f", {name.replace('_', ' ')} '{value}'" for name, value in self.__wanted.items()
        )
        return f'StateTransition of {target_in_words(self.__target)}{wanted}'

    def _is_meant(self, event: Any) -> bool:
        return (
            isinstance(event, StateTransition)
            and (self.__target is None or event.action is self.__target)
            and all(getattr(event, name) == value for name, value in self.__wanted.items())
        )


def _warn_of_unknown_states(*labels: Optional[str]) -> None:
    """Log a warning for each label that is not a state of lifecycle nodes."""
    for label in labels:
        if label is None or label in _STATES:
            continue
        from launch.logging import get_logger
        from ros_environment.suggestions import closest_name

        close = closest_name(label, _STATES, 0.5)
        get_logger('launch_ros.event_handlers').warning(
            "OnStateTransition waits for the state '%s', which lifecycle nodes do not have%s",
            label,
            f": did you mean '{close}'?" if close else f'; they are: {", ".join(_STATES)}',
        )
