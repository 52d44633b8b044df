# SPDX-License-Identifier: Apache-2.0
"""React to signals while a launch runs."""

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
    """Call `react` from the loop on signals that ask to end; restore what was before."""
    before: dict[signal.Signals, Any] = {
        number: signal.getsignal(number) for number in _WATCHED if _is_wanted(number)
    }

    def on_signal(number: int, frame: object) -> None:
        """Wake up the loop, which waits for files only, and let it react."""
        loop.call_soon_threadsafe(react, signal.Signals(number))

    for number in before:
        signal.signal(number, on_signal)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, signal.SIG_DFL if handler is None else handler)


def _is_wanted(number: signal.Signals) -> bool:
    """Return whether a signal is to be handled: not a hang-up that nohup ignores."""
    return number != signal.SIGHUP or signal.getsignal(number) != signal.SIG_IGN
