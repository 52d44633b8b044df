# SPDX-License-Identifier: Apache-2.0
"""Pause and resume, from the keyboard and from other nodes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

__all__ = ['PauseSwitch', 'offer_pause_services']


class PauseSwitch:
    """Whether the work is paused; `say` is told each change."""

    def __init__(self, is_paused: bool, say: Callable[[str], object]) -> None:
        """Start running or paused."""
        self.is_paused = is_paused
        self._say = say

    def change_to(self, is_paused: bool) -> None:
        """Pause or resume."""
        if is_paused != self.is_paused:
            self.is_paused = is_paused
            self._say('Paused.' if is_paused else 'Resumed.')

    def toggle(self) -> None:
        """Change to the other."""
        self.change_to(not self.is_paused)


def offer_pause_services(node: Any, switch: PauseSwitch) -> None:
    """Offer the services ~/pause, ~/resume and ~/toggle_paused."""
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
