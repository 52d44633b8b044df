# SPDX-License-Identifier: Apache-2.0
"""Chains of lifecycle transitions."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from typing import Any, Optional, TYPE_CHECKING

from launch.actions.emit_event import EmitEvent
from launch.event_handler import BaseEventHandler
from launch.logging import get_logger
from launch_ros.events.lifecycle.change_state import ChangeState
from launch_ros.events.lifecycle.state_transition import StateTransition
from launch_ros.events.matchers import matches_node_name

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

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


class TransitionChain(BaseEventHandler):
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
                'are left out',
                self._node_name,
                event.goal_state,
                _GOALS[self._current],
            )
        return None
