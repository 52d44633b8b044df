# SPDX-License-Identifier: Apache-2.0
"""Events of lifecycle nodes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TYPE_CHECKING
import warnings

from launch.event import Event
from launch_ros.events import matchers
from ros_environment.lazy import also_found_at, lazy_exports

if TYPE_CHECKING:
    from launch_ros.actions.lifecycle_node import LifecycleNode
    from launch_ros.actions.node import Node

__all__ = [
    'ChangeState',
    'StateTransition',
    'matches_node_name',
]


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


class StateTransition(Event):
    """
    A lifecycle node has gone from one state to another.

    Parameters
    ----------
    action
        The action that runs the node.
    msg
        The message that the node published (lifecycle_msgs/TransitionEvent).

    """

    name = 'launch_ros.events.lifecycle.StateTransition'

    def __init__(self, *, action: LifecycleNode, msg: Any) -> None:
        self.__action = action
        self.__msg = msg

    @property
    def action(self) -> LifecycleNode:
        """Return the action that runs the node."""
        return self.__action

    @property
    def msg(self) -> Any:
        """Return the message."""
        return self.__msg

    @property
    def timestamp(self) -> int:
        """Return the timestamp of the message, in nanoseconds."""
        return int(self.__msg.timestamp)

    @property
    def transition(self) -> str:
        """Return the label of the transition."""
        return str(self.__msg.transition.label)

    @property
    def start_state(self) -> str:
        """Return the label of the previous state."""
        return str(self.__msg.start_state.label)

    @property
    def goal_state(self) -> str:
        """Return the label of the new state."""
        return str(self.__msg.goal_state.label)


def matches_node_name(node_name: str) -> Callable[[Node], bool]:
    """
    Return a predicate that matches nodes by fully qualified name (deprecated here).

    Parameters
    ----------
    node_name
        As for `launch_ros.events.matches_node_name`.

    """
    warnings.warn(
        'launch_ros.events.lifecycle.matches_node_name is deprecated; import matches_node_name '
        'from launch_ros.events instead',
        UserWarning,
        stacklevel=2,
    )
    return matchers.matches_node_name(node_name)


# ROS 2 Jazzy has a module for each of them; launch files import from those, too.
also_found_at(__name__, 'change_state', 'lifecycle_node_matchers', 'state_transition')

__getattr__, __dir__ = lazy_exports(__name__, __all__)
