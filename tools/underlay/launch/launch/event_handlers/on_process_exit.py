# SPDX-License-Identifier: Apache-2.0
"""Event handler for the exit of processes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Optional, TYPE_CHECKING, Union

from launch.event_handlers.on_action_event_base import OnActionEventBase, Reaction
from launch.events.process import ProcessExited

if TYPE_CHECKING:
    from launch.actions.execute_local import ExecuteLocal


class OnProcessExit(OnActionEventBase):
    """
    Event handler that reacts when a process has ended.

    Parameters
    ----------
    target_action
        The action of a process, a predicate that accepts such, or None for all.
    on_exit
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
        target_action: Optional[Union[Callable[[Any], bool], ExecuteLocal]] = None,
        on_exit: Reaction,
        **kwargs: Any,
    ) -> None:
        from launch.actions.execute_local import ExecuteLocal

        super().__init__(
            action_matcher=target_action,
            on_event=on_exit,
            target_event_cls=ProcessExited,
            target_action_cls=ExecuteLocal,
            **kwargs,
        )
