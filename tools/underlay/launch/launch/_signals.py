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
    for number in before:
        loop.add_signal_handler(number, react, number)
    try:
        yield
    finally:
        for number, handler in before.items():
            loop.remove_signal_handler(number)
            signal.signal(number, signal.SIG_DFL if handler is None else handler)


def _is_wanted(number: signal.Signals) -> bool:
    """Return whether a signal is to be handled: not a hang-up that nohup ignores."""
    return number != signal.SIGHUP or signal.getsignal(number) != signal.SIG_IGN
