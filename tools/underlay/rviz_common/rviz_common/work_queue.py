# SPDX-License-Identifier: Apache-2.0
"""A queue of work for another thread."""

from __future__ import annotations

from collections.abc import Callable
import queue

__all__ = ['WorkQueue']

Work = Callable[[], None]


class WorkQueue:
    """
    Thread-safe queue of callables, which one thread runs in the order of their arrival.

    Parameters
    ----------
    on_post
        Called after each `post`, in the thread of the caller, to wake the worker thread.

    """

    def __init__(self, on_post: Work = lambda: None) -> None:
        self._waiting: queue.SimpleQueue[Work] = queue.SimpleQueue()
        self._on_post = on_post

    def post(self, work: Work) -> None:
        """
        Queue work; any thread may call it.

        Parameters
        ----------
        work
            Called without arguments by the thread that calls `run`.

        """
        self._waiting.put(work)
        self._on_post()

    def run(self) -> None:
        """Run all queued work."""
        while True:
            try:
                work = self._waiting.get_nowait()
            except queue.Empty:
                return
            work()
