# SPDX-License-Identifier: Apache-2.0
"""The wish that a node ends, made by a signal and fulfilled by the loop of the node."""

from __future__ import annotations

from collections.abc import Callable
import threading


class StopRequest:
    """Made once, from any thread; whoever waits is woken."""

    def __init__(self) -> None:
        """Start without a request, and with nobody to wake."""
        self._made = threading.Event()
        self._lock = threading.Lock()
        self._wake: Callable[[], None] | None = None
        self.at_once = False
        """Whether it is better to break off what runs than to let it come to its end."""

    @property
    def is_made(self) -> bool:
        """Tell whether the node is to end."""
        return self._made.is_set()

    def make(self) -> None:
        """Ask the node to end."""
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
