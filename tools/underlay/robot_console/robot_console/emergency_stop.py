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
        """Take note of what somebody says with this console."""
        self.pressed, self.by, self.heard = pressed, by, True

    def hear(self, pressed: bool) -> None:
        """Take note of what was published, by this console or by others."""
        if pressed != self.pressed or not self.heard:
            self.say(pressed, '')
