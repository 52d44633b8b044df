# SPDX-License-Identifier: Apache-2.0
"""Which frames are shown."""

from __future__ import annotations

import re

__all__ = ['FrameFilter']


class FrameFilter:
    """Shows the frames in which one expression is found, and not another one."""

    def __init__(self, shown: str = '', hidden: str = '') -> None:
        """Take regular expressions, or raise ValueError; an empty one stands for nothing."""
        self._shown, self._hidden = _compiled(shown), _compiled(hidden)
        self._decided: dict[str, bool] = {}

    def shows(self, frame: str) -> bool:
        """Tell if a frame is shown."""
        if frame not in self._decided:
            self._decided[frame] = self._decide(frame)
        return self._decided[frame]

    def _decide(self, frame: str) -> bool:
        if self._shown is not None and not self._shown.search(frame):
            return False
        return self._hidden is None or not self._hidden.search(frame)


def _compiled(expression: str) -> re.Pattern[str] | None:
    try:
        return re.compile(expression) if expression else None
    except re.error as error:
        raise ValueError(f"'{expression}' is no regular expression: {error}.") from None
