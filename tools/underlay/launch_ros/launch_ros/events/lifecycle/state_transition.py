# SPDX-License-Identifier: Apache-2.0
"""Event of a completed lifecycle transition."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from launch_ros.actions.lifecycle_node import LifecycleNode


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
