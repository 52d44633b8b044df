# SPDX-License-Identifier: Apache-2.0
"""What a program hears from the console that started it, and tells it."""

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
    Commands from the standard input, one JSON object a line.

    It is cut when the console has closed it, or is gone. A program that does not end then within
    a while, because something hangs, is ended. To be constructed in the main thread.

    Parameters
    ----------
    on_cut
        Called in another thread when the standard input is closed.

    Attributes
    ----------
    is_cut
        Whether it is closed.

    """

    def __init__(self, on_cut: Callable[[], None] = lambda: None) -> None:
        self._waiting: queue.SimpleQueue[dict[str, Any]] = queue.SimpleQueue()
        self._on_cut = on_cut
        self.is_cut = False
        _hear_signals()
        threading.Thread(target=self._listen, daemon=True).start()

    def commands(self, timeout_s: float = 0.0) -> list[dict[str, Any]]:
        """
        Get the commands that have come.

        Parameters
        ----------
        timeout_s
            For how long to wait for the first one, in s. The end of the input ends the wait as
            well.

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
        self._waiting.put(CUT)  # wakes who waits
        self._on_cut()
        time.sleep(GRACE_S)
        os._exit(1)


def _lines() -> Iterator[bytes]:
    """Yield the lines of the standard input, with no lock that the end would wait for."""
    text = b''
    while part := os.read(sys.stdin.fileno(), CHUNK_BYTES):
        *lines, text = (text + part).split(b'\n')
        yield from lines


def _hear_signals() -> None:
    """Let signals end this program, although who started it has blocked or ignored them."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, SIGNALS)


def interrupt_self() -> None:
    """Do to this process what Ctrl-C does."""
    os.kill(os.getpid(), signal.SIGINT)


def tell(**facts: Any) -> None:
    """
    Report facts to the console on the standard output; ignored if the console is gone.

    Parameters
    ----------
    **facts
        The members of a JSON object, which update `Child.facts`.

    """
    try:
        sys.stdout.write(json.dumps(facts) + '\n')
        sys.stdout.flush()
    except OSError:
        pass
