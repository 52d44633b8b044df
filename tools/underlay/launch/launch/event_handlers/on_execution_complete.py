# SPDX-License-Identifier: Apache-2.0
"""Event handler for the completion of actions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Optional, TYPE_CHECKING, Union

from launch.event_handlers.on_action_event_base import OnActionEventBase, Reaction
from launch.events import ExecutionComplete

if TYPE_CHECKING:
    from launch.action import Action


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

        super().__init__(
            action_matcher=target_action,
            on_event=on_completion,
            target_event_cls=ExecutionComplete,
            target_action_cls=Action,
            **kwargs,
        )
