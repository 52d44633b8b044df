# SPDX-License-Identifier: Apache-2.0
"""Communication of a child process with the console that started it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import json
import os
import queue
import signal
import sys
import threading
import time
from typing import Any

__all__ = ['Lifeline', 'interrupt_self', 'tell']

GRACE_S = 20.0
CHUNK_BYTES = 65536
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
CUT: dict[str, Any] = {}


class Lifeline:
    """
    Receiver of commands from standard input, one JSON object per line.

    The lifeline is cut when the console closes the input or dies. If the program then does not
    exit within 20 s, because it hangs, it is terminated. Construct it in the main thread.

    Parameters
    ----------
    on_cut
        Called in another thread when standard input is closed.

    Attributes
    ----------
    is_cut
        Whether standard input is closed.

    """

    def __init__(self, on_cut: Callable[[], None] = lambda: None) -> None:
        self._waiting: queue.SimpleQueue[dict[str, Any]] = queue.SimpleQueue()
        self._on_cut = on_cut
        self.is_cut = False
        _hear_signals()
        threading.Thread(target=self._listen, daemon=True).start()

    def commands(self, timeout_s: float = 0.0) -> list[dict[str, Any]]:
        """
        Return the commands received so far.

        Parameters
        ----------
        timeout_s
            The time to wait for the first command, in s. The end of input also ends the wait.

        Returns
        -------
        list of dict
            The commands in order, often none.

        """
        found = []
        try:
            found.append(self._waiting.get(timeout=max(0.0, timeout_s)))
            while True:
                found.append(self._waiting.get_nowait())
        except queue.Empty:
            return [each for each in found if each]

    def _listen(self) -> None:
        for line in _lines():
            self._waiting.put(json.loads(line))
        self.is_cut = True
        self._waiting.put(CUT)  # wakes up a waiting reader
        self._on_cut()
        time.sleep(GRACE_S)
        os._exit(1)


def _lines() -> Iterator[bytes]:
    """Yield the lines of standard input, without a lock that would delay the exit."""
    text = b''
    while part := os.read(sys.stdin.fileno(), CHUNK_BYTES):
        *lines, text = (text + part).split(b'\n')
        yield from lines


def _hear_signals() -> None:
    """Restore the handling of signals that the parent process may have blocked or ignored."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, SIGNALS)


def interrupt_self() -> None:
    """Send SIGINT to this process, like Ctrl-C."""
    os.kill(os.getpid(), signal.SIGINT)


def tell(**facts: Any) -> None:
    """
    Report facts to the console on standard output; ignored if the console is gone.

    Parameters
    ----------
    **facts
        The members of a JSON object, which updates `Child.facts`.

    """
    try:
        sys.stdout.write(json.dumps(facts) + '\n')
        sys.stdout.flush()
    except OSError:
        pass
