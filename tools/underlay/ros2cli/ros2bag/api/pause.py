# SPDX-License-Identifier: Apache-2.0
"""Pause and resume, from the keyboard and from other nodes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

__all__ = ['PauseSwitch', 'offer_pause_services']


class PauseSwitch:
    """
    The paused state of a recorder or player.

    Parameters
    ----------
    is_paused
        Whether it starts paused; also an attribute with the current state.
    say
        Called with a message at each change.

    """

    def __init__(self, is_paused: bool, say: Callable[[str], object]) -> None:
        self.is_paused = is_paused
        self._say = say

    def change_to(self, is_paused: bool) -> None:
        """
        Pause or resume; nothing is reported without a change.

        Parameters
        ----------
        is_paused
            Whether to pause.

        """
        if is_paused != self.is_paused:
            self.is_paused = is_paused
            self._say('Paused.' if is_paused else 'Resumed.')

    def toggle(self) -> None:
        """Toggle the paused state."""
        self.change_to(not self.is_paused)


def offer_pause_services(node: Any, switch: PauseSwitch) -> None:
    """
    Create the services `~/pause`, `~/resume` and `~/toggle_paused` (std_srvs/srv/Trigger).

    Parameters
    ----------
    node
        The node that offers them.
    switch
        The paused state that they change.

    """
    from std_srvs.srv import Trigger

    def offer(name: str, act: Callable[[], None]) -> None:
        def serve(_: Any, response: Any) -> Any:
            act()
            response.success = True
            response.message = 'paused' if switch.is_paused else 'running'
            return response

        node.create_service(Trigger, f'~/{name}', serve)

    offer('pause', lambda: switch.change_to(True))
    offer('resume', lambda: switch.change_to(False))
    offer('toggle_paused', switch.toggle)
