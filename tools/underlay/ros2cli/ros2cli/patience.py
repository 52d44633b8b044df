# SPDX-License-Identifier: Apache-2.0
"""Report of what a command waits for."""

from __future__ import annotations

from collections.abc import Callable
import sys
import time

PATIENCE_S = 2.0


class Patience:
    """
    Reports once, on stderr, what a command waits for, after 2 s of waiting.

    Parameters
    ----------
    what
        The subject of the wait, as in "Still waiting for ...".
    hint
        Called with the report; returns a hint, or ''.

    """

    def __init__(self, what: str, hint: Callable[[], str] = str) -> None:
        self._what = what
        self._hint = hint
        self._end = time.monotonic() + PATIENCE_S

    def check(self) -> None:
        """Print the report if it is due."""
        if time.monotonic() > self._end:
            text = f'Still waiting for {self._what} (Ctrl-C to stop)'
            print('. '.join(filter(None, (text, self._hint()))), file=sys.stderr)
            self._end = float('inf')
