# SPDX-License-Identifier: Apache-2.0
"""Wait until transforms are available in a buffer."""

from __future__ import annotations

from collections.abc import Callable
import threading
import time
from typing import Any

Check = Callable[[], bool]
_LOOK_S = 0.1


class Waiting:
    """
    Registry of threads and futures that wait for transforms.

    Parameters
    ----------
    is_alive
        Threads stop waiting as soon as this returns False, such as after a ROS shutdown.

    """

    def __init__(self, is_alive: Callable[[], bool]) -> None:
        self._is_alive = is_alive
        self._changed = threading.Condition()
        self._threads = 0
        self._futures: list[tuple[Check, Any]] = []
        self._feeding_thread = 0

    def until(self, check: Check, timeout_s: float) -> None:
        """
        Block until a check succeeds, a timeout expires or ROS is shut down.

        Parameters
        ----------
        check
            Whether the transform is available; called again after each change of the buffer.
        timeout_s
            The maximum time to block, in s of wall clock time.

        """
        end_s = time.monotonic() + timeout_s
        with self._changed:
            self._threads += 1
            try:
                while not check() and self._is_alive():
                    left_s = end_s - time.monotonic()
                    if left_s <= 0.0:
                        break
                    self._changed.wait(min(left_s, _LOOK_S))
            finally:
                self._threads -= 1

    def add(self, check: Check, future: Any) -> None:
        """
        Complete a future with True as soon as a check succeeds.

        Parameters
        ----------
        check
            Whether the transform is available; called again after each change of the buffer.
        future
            The future to complete; it is dropped if it was canceled or completed before.

        """
        with self._changed:
            self._futures.append((check, future))
        self._settle()

    def announce(self) -> None:
        """Notify waiting threads and futures that the buffer has changed."""
        self._feeding_thread = threading.get_ident()
        if self._threads:
            with self._changed:
                self._changed.notify_all()
        if self._futures:
            self._settle()

    def blocks_itself(self) -> bool:
        """Whether the calling thread is the one that fills the buffer, and so must not block."""
        return self._feeding_thread == threading.get_ident()

    def _settle(self) -> None:
        with self._changed:
            entries = [entry for entry in self._futures if not _is_over(entry[1])]
            ready = [entry for entry in entries if entry[0]()]
            self._futures = [entry for entry in entries if entry not in ready]
        for _, future in ready:
            future.set_result(True)


def _is_over(future: Any) -> bool:
    return bool(future.done() or future.cancelled())
