# SPDX-License-Identifier: Apache-2.0
"""Launch action for chains of lifecycle transitions."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from typing import Any, Optional, Union

from launch.action import Action
from launch.actions.event_actions import EmitEvent, RegisterEventHandler
from launch.event_handler import BaseEventHandler
from launch.launch_context import LaunchContext
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.logging import get_logger
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.type_utils import normalize_typed_substitution, perform_typed_substitution
from launch_ros.events.lifecycle import ChangeState, StateTransition
from launch_ros.events.matchers import matches_node_name

# The goal state of each transition.
_GOALS = {
    1: 'inactive',
    2: 'unconfigured',
    3: 'active',
    4: 'inactive',
    5: 'finalized',
    6: 'finalized',
    7: 'finalized',
}
_STATES_TO_STAY_IN = frozenset(_GOALS.values())


class LifecycleTransition(Action):
    """
    Takes each of some lifecycle nodes of this launch through a chain of transitions.

    Parameters
    ----------
    lifecycle_node_names
        The fully qualified names of the nodes; the leading slash is optional.
    transition_ids
        Constants of lifecycle_msgs.msg.Transition, or substitutions for them, in order.
    **kwargs
        As for `Action`: `condition`.

    Raises
    ------
    ValueError
        There are no names or no transitions, or a string is given instead of a list.

    """

    def __init__(
        self,
        *,
        lifecycle_node_names: Iterable[SomeSubstitutionsType],
        transition_ids: Iterable[Union[int, SomeSubstitutionsType]],
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.__names = [
            normalize_to_list_of_substitutions(name)
            for name in _some('lifecycle_node_names', lifecycle_node_names)
        ]
        self.__transition_ids = [
            normalize_typed_substitution(each, int)
            for each in _some('transition_ids', transition_ids)
        ]

    @property
    def lifecycle_node_names(self) -> list[list[Substitution]]:
        """Return the node names, as substitutions."""
        return self.__names

    @property
    def transition_ids(self) -> list[Any]:
        """Return the transition ids, or the substitutions that evaluate to them."""
        return self.__transition_ids

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """
        Request the first transition of each node; an event handler requests the others.

        Parameters
        ----------
        context
            The launch context used to perform substitutions.

        Returns
        -------
        list of LaunchDescriptionEntity
            For each node, the action that registers its chain and the one that emits the first
            event.

        Raises
        ------
        ValueError
            A transition cannot be part of a chain.

        """
        transition_ids = [
            perform_typed_substitution(context, each, int) for each in self.__transition_ids
        ]
        entities: list[LaunchDescriptionEntity] = []
        for parts in self.__names:
            chain = _TransitionChain(perform_substitutions(context, parts), transition_ids)
            entities += [RegisterEventHandler(chain), EmitEvent(event=chain.next_request())]
        return entities


def _some(name: str, values: Iterable[Any]) -> list[Any]:
    """Convert values to a list; reject strings and empty lists."""
    found = [] if isinstance(values, str) else list(values)
    if not found:
        raise ValueError(f'{name} of LifecycleTransition must be a list of at least one item')
    return found


class _TransitionChain(BaseEventHandler):
    """
    Event handler that requests the next transition once the previous one has succeeded.

    The chain ends when a transition does not reach its goal state.

    Parameters
    ----------
    node_name
        The fully qualified name of the node; the leading slash is optional.
    transition_ids
        Constants of lifecycle_msgs/Transition that lead to a primary state, in order.

    Raises
    ------
    ValueError
        A transition cannot be part of a chain (valid: 1 to 7).

    """

    def __init__(self, node_name: str, transition_ids: Iterable[int]) -> None:
        super().__init__(matcher=self._is_step)
        self._node_name = node_name
        self._is_node = matches_node_name(node_name)
        self._left = deque(transition_ids)
        self._current = 0
        for each in self._left:
            if each not in _GOALS:
                raise ValueError(
                    f'the transition id {each} cannot be part of a chain of transitions; those '
                    'that can are: '
                    + ', '.join(f'{key} ({ChangeState.valid_transitions[key]})' for key in _GOALS)
                )

    def next_request(self) -> ChangeState:
        """Return the event that requests the next transition."""
        self._current = self._left.popleft()
        return ChangeState(lifecycle_node_matcher=self._is_node, transition_id=self._current)

    def _is_step(self, event: Any) -> bool:
        return (
            isinstance(event, StateTransition)
            and event.goal_state in _STATES_TO_STAY_IN
            and self._is_node(event.action)
        )

    def handle(self, event: Any, context: LaunchContext) -> Optional[EmitEvent]:
        """
        Request the next transition, or end the chain and log a failure.

        Parameters
        ----------
        event
            A StateTransition of the node to a primary state.
        context
            The context with which the handler is registered; unregistered at the end of the chain.

        Returns
        -------
        EmitEvent or None
            The action that requests the next transition; None if the chain has ended.

        """
        super().handle(event, context)
        succeeded = event.goal_state == _GOALS[self._current]
        if succeeded and self._left:
            return EmitEvent(event=self.next_request())
        context.unregister_event_handler(self)
        if not succeeded:
            get_logger('launch_ros.actions.lifecycle_transition').error(
                "'%s' went to the state '%s' instead of '%s': the transitions that should follow "
                'are skipped',
                self._node_name,
                event.goal_state,
                _GOALS[self._current],
            )
        return None
