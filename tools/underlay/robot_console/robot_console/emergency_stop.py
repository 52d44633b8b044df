# SPDX-License-Identifier: Apache-2.0
"""What is known of the emergency stop of a robot."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ['EmergencyStop']


@dataclass
class EmergencyStop:
    """Whether it is pressed, and who said so last."""

    pressed: bool = False
    by: str = ''
    """Who of this console's people said so; empty if somebody else did, or nobody."""
    heard: bool = False
    """Whether anybody has said anything yet."""

    def say(self, pressed: bool, by: str) -> None:
        """
        Record that somebody presses or releases the emergency stop with this console.

        Parameters
        ----------
        pressed
            Whether it is pressed from now on.
        by
            The name of the person.

        """
        self.pressed, self.by, self.heard = pressed, by, True

    def hear(self, pressed: bool) -> None:
        """
        Update the state of the emergency stop from the topic, whoever has published there.

        An echo of what this console said itself keeps the name of the person.

        Parameters
        ----------
        pressed
            Whether the message says that it is pressed.

        """
        if pressed != self.pressed or not self.heard:
            self.say(pressed, '')
