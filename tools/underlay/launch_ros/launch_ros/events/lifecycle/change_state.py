# SPDX-License-Identifier: Apache-2.0
"""Event that requests lifecycle transitions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from launch_ros.actions.lifecycle_node import LifecycleNode


class ChangeState(Event):
    """
    Requests a transition of the lifecycle nodes that a matcher accepts.

    Parameters
    ----------
    lifecycle_node_matcher
        Predicate of LifecycleNode actions; selects the nodes to change.
    transition_id
        A constant of lifecycle_msgs.msg.Transition.

    Raises
    ------
    ValueError
        The transition is not among `valid_transitions`.

    """

    name = 'launch_ros.events.lifecycle.ChangeState'

    # The transitions of lifecycle_msgs/Transition that can be requested.
    valid_transitions = {
        0: 'TRANSITION_CREATE',
        1: 'TRANSITION_CONFIGURE',
        2: 'TRANSITION_CLEANUP',
        3: 'TRANSITION_ACTIVATE',
        4: 'TRANSITION_DEACTIVATE',
        5: 'TRANSITION_UNCONFIGURED_SHUTDOWN',
        6: 'TRANSITION_INACTIVE_SHUTDOWN',
        7: 'TRANSITION_ACTIVE_SHUTDOWN',
        8: 'TRANSITION_DESTROY',
    }

    def __init__(
        self,
        *,
        lifecycle_node_matcher: Callable[[LifecycleNode], bool],
        transition_id: int,
    ) -> None:
        if transition_id not in self.valid_transitions:
            known = ', '.join(f'{key} ({name})' for key, name in self.valid_transitions.items())
            raise ValueError(
                f"transition_id of ChangeState is invalid: '{transition_id}'; the transitions "
                f'that can be asked for are: {known}'
            )
        self.__lifecycle_node_matcher = lifecycle_node_matcher
        self.__transition_id = transition_id

    def outline(self) -> dict[str, Any]:
        """Return the facts about the event: its class and the transition."""
        transition = self.valid_transitions[self.__transition_id]
        return {**super().outline(), 'transition': transition}

    @property
    def lifecycle_node_matcher(self) -> Callable[[LifecycleNode], bool]:
        """Return the matcher."""
        return self.__lifecycle_node_matcher

    @property
    def transition_id(self) -> int:
        """Return the id of the transition."""
        return self.__transition_id
