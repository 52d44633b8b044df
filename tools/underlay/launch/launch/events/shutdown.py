# SPDX-License-Identifier: Apache-2.0
"""The event of the shutdown."""

from __future__ import annotations

from launch.event import Event


class Shutdown(Event):
    """
    Event of the shutdown of the launch.

    Parameters
    ----------
    reason
        The reason for the shutdown, for the user.
    due_to_sigint
        Whether the user pressed Ctrl-C.

    """

    name = 'launch.events.Shutdown'

    def __init__(
        self,
        *,
        reason: str = 'reason not given',
        due_to_sigint: bool = False,
    ) -> None:
        self.__reason = reason
        self.__due_to_sigint = due_to_sigint

    @property
    def reason(self) -> str:
        """Return the reason for the shutdown."""
        return self.__reason

    @property
    def due_to_sigint(self) -> bool:
        """Whether the user pressed Ctrl-C."""
        return self.__due_to_sigint
