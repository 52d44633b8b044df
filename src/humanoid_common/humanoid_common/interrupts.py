# SPDX-License-Identifier: Apache-2.0
"""Signals that end a process: SIGINT and SIGTERM, which ask it to stop, and its parent's end."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import ctypes
import signal
import socket
import threading
import time
from types import FrameType

STOP_SIGNALS = (signal.SIGINT, signal.SIGTERM)
WAKE_S = 0.05
"""Time for the main thread to handle a signal before it is sent again."""
JOIN_S = 1.0
"""Maximum wait for the thread at the end of a node; it has nothing left to do then."""
_PR_SET_PDEATHSIG = 1


class StopRequest:
    """Stop request that is made once, from any thread, and wakes the waiting loop."""

    def __init__(self) -> None:
        self._made = threading.Event()
        self._lock = threading.Lock()
        self._wake: Callable[[], None] | None = None
        self.at_once = False
        """Whether to interrupt what runs rather than let it finish."""

    @property
    def is_made(self) -> bool:
        """Whether the node is to stop."""
        return self._made.is_set()

    def make(self) -> None:
        """Request the node to stop."""
        with self._lock:
            self._made.set()
            if self._wake is not None:
                self._wake()

    def wake_with(self, wake: Callable[[], None] | None) -> None:
        """
        Set the callback of the stop request; it is called at once if the request was made already.

        Parameters
        ----------
        wake
            Called when the request is made, from the thread that makes it; None for nothing.

        """
        with self._lock:
            self._wake = wake
            if wake is not None and self._made.is_set():
                wake()


class PatientInterrupt:
    """
    Signal handler that lets the node end by itself.

    Raising KeyboardInterrupt would interrupt whatever runs at that moment. It is raised only by a
    further signal after the patience, so that a callback that never returns can be ended, or when
    the request is to interrupt at once.

    Parameters
    ----------
    request
        The stop request of the node; `at_once` makes the first signal raise.
    patience_s
        How long after the first signal the node may take to end by itself.
    clock
        Returns the time of a steady clock in s.

    Attributes
    ----------
    was_called
        Whether a signal has come.

    """

    def __init__(
        self,
        request: StopRequest,
        patience_s: float = 1.0,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._request = request
        self._patience_s = patience_s
        self._clock = clock
        self._first_s: float | None = None
        self.was_called = False

    def __call__(self, number: int, frame: FrameType | None) -> None:
        """Handle a signal; raise KeyboardInterrupt if the patience has run out."""
        self.was_called = True
        if self._request.at_once:
            self._request.make()
            raise KeyboardInterrupt
        now_s = self._clock()
        if self._first_s is None:
            self._first_s = now_s
        elif now_s - self._first_s > self._patience_s:
            raise KeyboardInterrupt


@contextmanager
def stop_on_signals() -> Iterator[StopRequest]:
    """
    Turn SIGINT and SIGTERM into a request to stop.

    The main thread may be blocked inside ROS, where no Python runs. The interpreter therefore
    writes the number of each signal to a socket, and a dedicated thread reads it and makes the
    request. After the block both signals are ignored, as the process is about to end.

    A signal that arrives just before the main thread blocks, or in another thread, does not end
    its wait: while the node is being created, the dedicated thread sends it again.
    """
    request = StopRequest()
    reader, writer = socket.socketpair()
    with reader, writer:
        writer.setblocking(False)
        signal.set_wakeup_fd(writer.fileno(), warn_on_full_buffer=False)
        handler = PatientInterrupt(request)
        for number in STOP_SIGNALS:
            signal.signal(number, handler)
        watcher = threading.Thread(target=_watch, args=(reader, request, handler), daemon=True)
        watcher.start()
        try:
            yield request
        finally:
            for number in STOP_SIGNALS:
                signal.signal(number, signal.SIG_IGN)
            signal.set_wakeup_fd(-1)
            writer.shutdown(socket.SHUT_RDWR)
            watcher.join(JOIN_S)


def _watch(reader: socket.socket, request: StopRequest, handler: PatientInterrupt) -> None:
    """Make the request for each stop signal, until the socket is shut down."""
    while numbers := reader.recv(64):
        stops = [number for number in numbers if number in STOP_SIGNALS]
        if stops:
            request.make()
            _wake_main_thread(stops[-1], request, handler)


def _wake_main_thread(number: int, request: StopRequest, handler: PatientInterrupt) -> None:
    """Resend a signal that the main thread has not handled, as it is blocked in the kernel."""

    def is_unseen() -> bool:
        return request.at_once and not handler.was_called

    if is_unseen():
        time.sleep(WAKE_S)
    main = threading.main_thread().ident
    if main is not None and is_unseen():
        signal.pthread_kill(main, number)


def end_with_parent(number: signal.Signals) -> None:
    """
    Let the kernel send this process a signal when the process that started it is no more.

    Parameters
    ----------
    number
        The signal.

    """
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, number)
