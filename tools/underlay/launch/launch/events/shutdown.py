# SPDX-License-Identifier: Apache-2.0
"""The event of the shutdown."""

from __future__ import annotations

from launch.event import Event


class Shutdown(Event):
    """The launch is to end."""

    name = 'launch.events.Shutdown'

    def __init__(
        self,
        *,
        reason: str = 'reason not given',
        due_to_sigint: bool = False,
    ) -> None:
        """Create the event, with the reason for people."""
        self.__reason = reason
        self.__due_to_sigint = due_to_sigint

    @property
    def reason(self) -> str:
        """Return why the launch ends."""
        return self.__reason

    @property
    def due_to_sigint(self) -> bool:
        """Return whether the user pressed Ctrl-C."""
        return self.__due_to_sigint
