# SPDX-License-Identifier: Apache-2.0
"""The console output of the set-up: numbered steps, progress within a step, and errors."""

from __future__ import annotations

import sys
import time


class SetupError(Exception):
    """An error that ends the set-up; its message includes a remedy."""


class Steps:
    """
    Numbered steps with progress: a line that is rewritten on a terminal, else occasional lines.

    Parameters
    ----------
    count
        The number of steps.

    """

    QUIET_PERIOD_S = 5.0

    def __init__(self, count: int) -> None:
        self._count = count
        self._number = 0
        self._terminal = sys.stdout.isatty()
        self._line_open = False
        self._last_line_s = 0.0

    def begin(self, text: str) -> None:
        """
        Start the next step.

        Parameters
        ----------
        text
            The heading of the step, which is printed after its number.

        """
        self._close_line()
        self._number += 1
        print(f'[{self._number}/{self._count}] {text}', flush=True)
        self._last_line_s = time.monotonic()

    def progress(self, text: str) -> None:
        """
        Show the progress of the step; without a terminal, at most every `QUIET_PERIOD_S`.

        Parameters
        ----------
        text
            One line, which the next one replaces on a terminal.

        """
        if self._terminal:
            print(f'\r\033[K      {text}', end='', flush=True)
            self._line_open = True
        elif time.monotonic() - self._last_line_s >= self.QUIET_PERIOD_S:
            self.note(text)

    def note(self, text: str) -> None:
        """
        Print a line that stays on the screen.

        Parameters
        ----------
        text
            The line.

        """
        self._close_line()
        print(f'      {text}', flush=True)
        self._last_line_s = time.monotonic()

    def end(self) -> None:
        """End the line of the last progress."""
        self._close_line()

    def _close_line(self) -> None:
        if self._line_open:
            print('\r\033[K', end='', flush=True)
            self._line_open = False
