# SPDX-License-Identifier: Apache-2.0
"""Work that is to be done in another thread."""

from __future__ import annotations

from collections.abc import Callable
import queue

__all__ = ['WorkQueue']

Work = Callable[[], None]


class WorkQueue:
    """Takes work from any thread, which one thread does in the order of its coming."""

    def __init__(self, on_post: Work = lambda: None) -> None:
        """Take what wakes the thread that does the work."""
        self._waiting: queue.SimpleQueue[Work] = queue.SimpleQueue()
        self._on_post = on_post

    def post(self, work: Work) -> None:
        """Have something done soon."""
        self._waiting.put(work)
        self._on_post()

    def run(self) -> None:
        """Do what is waiting."""
        while True:
            try:
                work = self._waiting.get_nowait()
            except queue.Empty:
                return
            work()
