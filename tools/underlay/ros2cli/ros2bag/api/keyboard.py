# SPDX-License-Identifier: Apache-2.0
"""Non-blocking keyboard input from the terminal."""

from __future__ import annotations

import os
import select
import sys
import termios
from types import TracebackType
from typing import Any

__all__ = ['DOWN', 'RIGHT', 'SPACE', 'UP', 'Keyboard']

SPACE, UP, DOWN, RIGHT = ' ', '\x1b[A', '\x1b[B', '\x1b[C'
MAX_BYTES = 64


class Keyboard:
    """
    Non-blocking reader of pressed keys; use it in a `with` statement.

    It reports none if stdin is not a terminal, or if the command runs in the background.

    Parameters
    ----------
    enabled
        Whether to read keys at all; if not, the terminal is left alone.

    """

    def __init__(self, *, enabled: bool) -> None:
        self._is_wanted = enabled
        self._before: list[Any] | None = None

    def __enter__(self) -> Keyboard:
        """Disable the line buffering and echo of the terminal; Ctrl-C still sends SIGINT."""
        if self._is_wanted and _is_in_foreground():
            self._before = termios.tcgetattr(sys.stdin)
            raw = termios.tcgetattr(sys.stdin)
            raw[3] &= ~(termios.ICANON | termios.ECHO)
            termios.tcsetattr(sys.stdin, termios.TCSADRAIN, raw)
        return self

    def pressed(self) -> str:
        """Return the keys pressed since the last call; '' for none."""
        if self._before is None or not select.select([sys.stdin], [], [], 0)[0]:
            return ''
        return os.read(sys.stdin.fileno(), MAX_BYTES).decode(errors='ignore')

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Restore the terminal settings."""
        if self._before is not None:
            termios.tcsetattr(sys.stdin, termios.TCSADRAIN, self._before)


def _is_in_foreground() -> bool:
    """Whether stdin is a terminal and this process is in its foreground process group."""
    if sys.stdin is None or not sys.stdin.isatty():
        return False
    try:
        return os.tcgetpgrp(sys.stdin.fileno()) == os.getpgrp()
    except OSError:
        return False
