# SPDX-License-Identifier: Apache-2.0
"""What a display has in the scene."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

__all__ = ['Drawn']


class Drawn:
    """What a display has in the scene: what is drawn anew under its name replaces the old."""

    def __init__(self) -> None:
        """Begin with nothing."""
        self._handles: dict[str, Any] = {}

    def replace(self, handles: Iterable[Any]) -> None:
        """Take what has just been drawn, and remove what had other names."""
        new = {handle.name: handle for handle in handles}
        for name, old in self._handles.items():
            if name not in new:
                old.remove()
        self._handles = new

    def forget(self) -> None:
        """Take nothing for drawn, since what is above it has been removed."""
        self._handles = {}
