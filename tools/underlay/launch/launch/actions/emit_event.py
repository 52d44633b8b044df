# SPDX-License-Identifier: Apache-2.0
"""The action that emits an event."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from launch.action import Action
from launch.event import Event

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class EmitEvent(Action):
    """
    Action that emits an event, which is handled when all that is being visited is done.

    Parameters
    ----------
    event
        The event.
    **kwargs
        Keyword arguments of `Action`.

    Raises
    ------
    RuntimeError
        `event` is not an `Event`.

    """

    def __init__(self, *, event: Event, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        if not isinstance(event, Event):
            raise RuntimeError(
                f"EmitEvent expected an event, but got '{event!r}' of type "
                f"'{type(event).__name__}'"
            )
        self.__event = event

    @property
    def event(self) -> Event:
        """Return the event."""
        return self.__event

    def execute(self, context: LaunchContext) -> None:
        """
        Queue the event.

        Parameters
        ----------
        context
            The launch context, with the queue.

        """
        context.emit_event_sync(self.__event)
        if context.run.observer is not None:
            context.run.observer.note(**self.outline())

    def outline(self) -> dict[str, Any]:
        """Return the facts about the event."""
        return self.__event.outline()
