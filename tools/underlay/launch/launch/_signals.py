# SPDX-License-Identifier: Apache-2.0
"""Signal handling while a launch runs."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterator
from contextlib import contextmanager
import signal
from typing import Any

_WATCHED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)


@contextmanager
def handled_signals(
    loop: asyncio.AbstractEventLoop,
    react: Callable[[signal.Signals], None],
) -> Iterator[None]:
    """
    Handle termination signals within a context.

    These are SIGINT, SIGTERM, SIGQUIT, and SIGHUP unless it is ignored, as under nohup. The
    previous handlers are restored on exit. Use this in the main thread only.

    Parameters
    ----------
    loop
        The event loop that calls `react`.
    react
        Called with each signal.

    """
    before: dict[signal.Signals, Any] = {
        number: signal.getsignal(number) for number in _WATCHED if _is_wanted(number)
    }

    def on_signal(number: int, frame: object) -> None:
        """Wake up the loop, which only waits for file descriptors, and schedule the reaction."""
        loop.call_soon_threadsafe(react, signal.Signals(number))

    for number in before:
        signal.signal(number, on_signal)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, signal.SIG_DFL if handler is None else handler)


def _is_wanted(number: signal.Signals) -> bool:
    """Check whether to handle a signal; a SIGHUP that nohup ignores is not handled."""
    return number != signal.SIGHUP or signal.getsignal(number) != signal.SIG_IGN
