# SPDX-License-Identifier: Apache-2.0
"""The action that removes an event handler."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from launch.action import Action
from launch.event_handler import BaseEventHandler

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class UnregisterEventHandler(Action):
    """
    Action that removes an event handler.

    Parameters
    ----------
    event_handler
        The handler, which must be registered when the action is executed.
    **kwargs
        Keyword arguments of `Action`.

    """

    def __init__(self, event_handler: BaseEventHandler, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__event_handler = event_handler

    @property
    def event_handler(self) -> BaseEventHandler:
        """Return the handler."""
        return self.__event_handler

    def execute(self, context: LaunchContext) -> None:
        """
        Unregister the handler.

        Parameters
        ----------
        context
            The launch context.

        Raises
        ------
        ValueError
            The handler is not registered.

        """
        context.unregister_event_handler(self.__event_handler)
