# SPDX-License-Identifier: Apache-2.0
"""Stop request for a node, made by a signal and obeyed by the loop of the node."""

from __future__ import annotations

from collections.abc import Callable
import threading


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
