# SPDX-License-Identifier: Apache-2.0
"""A handler of the end of processes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Optional, TYPE_CHECKING, Union

from launch.event_handlers.on_action_event_base import OnActionEventBase, Reaction
from launch.events.process.process_exited import ProcessExited

if TYPE_CHECKING:
    from launch.actions.execute_local import ExecuteLocal


class OnProcessExit(OnActionEventBase):
    """Reacts when a process has ended."""

    def __init__(
        self,
        *,
        target_action: Optional[Union[Callable[[Any], bool], ExecuteLocal]] = None,
        on_exit: Reaction,
        **kwargs: Any,
    ) -> None:
        """Create a handler for one action, for those that a predicate accepts, or for all."""
        from launch.actions.execute_local import ExecuteLocal

        super().__init__(
            action_matcher=target_action,
            on_event=on_exit,
            target_event_cls=ProcessExited,
            target_action_cls=ExecuteLocal,
            **kwargs,
        )
