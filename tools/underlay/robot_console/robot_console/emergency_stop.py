# SPDX-License-Identifier: Apache-2.0
"""State of the emergency stop of a robot."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ['EmergencyStop']


@dataclass
class EmergencyStop:
    """State of the emergency stop, and who last changed it."""

    pressed: bool = False
    by: str = ''
    """The user of this console who last changed it; empty if another node did, or no one."""
    heard: bool = False
    """Whether any state was received or set yet."""

    def say(self, pressed: bool, by: str) -> None:
        """
        Record that a user of this console presses or releases the emergency stop.

        Parameters
        ----------
        pressed
            The new state: whether it is pressed.
        by
            The name of the user.

        """
        self.pressed, self.by, self.heard = pressed, by, True

    def hear(self, pressed: bool) -> None:
        """
        Update the state of the emergency stop from its topic, whichever node has published.

        The echo of a message published by this console keeps the name of the user.

        Parameters
        ----------
        pressed
            Whether the message reports that it is pressed.

        """
        if pressed != self.pressed or not self.heard:
            self.say(pressed, '')
