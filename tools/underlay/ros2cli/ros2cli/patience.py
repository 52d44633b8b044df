# SPDX-License-Identifier: Apache-2.0
"""Say what a command waits for."""

from __future__ import annotations

from collections.abc import Callable
import sys
import time

PATIENCE_S = 2.0


class Patience:
    """
    Tells once, on stderr, what a command waits for, when it has been waiting for 2 s.

    Parameters
    ----------
    what
        What is waited for, as in "Still waiting for ...".
    hint
        Called then; returns what may help, or ''.

    """

    def __init__(self, what: str, hint: Callable[[], str] = str) -> None:
        self._what = what
        self._hint = hint
        self._end = time.monotonic() + PATIENCE_S

    def check(self) -> None:
        """Speak up if the time has come."""
        if time.monotonic() > self._end:
            text = f'Still waiting for {self._what} (Ctrl-C to stop)'
            print('. '.join(filter(None, (text, self._hint()))), file=sys.stderr)
            self._end = float('inf')
