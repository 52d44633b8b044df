# SPDX-License-Identifier: Apache-2.0
"""The filter of frames by name."""

from __future__ import annotations

import re

__all__ = ['FrameFilter']


class FrameFilter:
    """
    Filter of frames by two regular expressions, matched anywhere in their names.

    Parameters
    ----------
    shown
        Must match the names of frames that are shown; '' for any name.
    hidden
        Must not match them; '' to hide none.

    Raises
    ------
    ValueError
        One of them is not a valid regular expression.

    """

    def __init__(self, shown: str = '', hidden: str = '') -> None:
        self._shown, self._hidden = _compiled(shown), _compiled(hidden)
        self._decided: dict[str, bool] = {}

    def shows(self, frame: str) -> bool:
        """
        Whether a frame passes the filter.

        Parameters
        ----------
        frame
            The name of the frame.

        """
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
