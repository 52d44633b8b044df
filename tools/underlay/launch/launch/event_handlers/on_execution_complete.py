# SPDX-License-Identifier: Apache-2.0
"""A handler of the completion of actions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Optional, TYPE_CHECKING, Union

from launch.event_handlers.on_action_event_base import OnActionEventBase, Reaction
from launch.events.execution_complete import ExecutionComplete

if TYPE_CHECKING:
    from launch.action import Action


class OnExecutionComplete(OnActionEventBase):
    """Reacts when an action is done."""

    def __init__(
        self,
        *,
        target_action: Optional[Union[Callable[[Any], bool], Action]] = None,
        on_completion: Reaction,
        **kwargs: Any,
    ) -> None:
        """Create a handler for one action, for those that a predicate accepts, or for all."""
        from launch.action import Action

        super().__init__(
            action_matcher=target_action,
            on_event=on_completion,
            target_event_cls=ExecutionComplete,
            target_action_cls=Action,
            **kwargs,
        )
