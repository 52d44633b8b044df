# SPDX-License-Identifier: Apache-2.0
"""What the set-up says: numbered steps, progress within a step, errors as sentences."""

from __future__ import annotations

import sys
import time


class SetupError(Exception):
    """Something that ends the set-up; its text is a sentence with a way out."""


class Steps:
    """
    Numbered steps with progress: a line that is rewritten on a terminal, else one at times.

    Parameters
    ----------
    count
        How many steps there will be.

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
        Show how far the step is; off a terminal, at most every `QUIET_PERIOD_S`.

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
        """Leave the line of the last progress."""
        self._close_line()

    def _close_line(self) -> None:
        if self._line_open:
            print('\r\033[K', end='', flush=True)
            self._line_open = False
