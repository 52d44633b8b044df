# SPDX-License-Identifier: Apache-2.0
"""
User input from widgets, and the queue that transfers it to another thread.

Widget callbacks run in other threads, and are also called for values set by a program.
"""

from __future__ import annotations

from collections.abc import Callable
import queue
from typing import Any

__all__ = ['Post', 'WorkQueue', 'on_choice', 'on_click', 'on_input']

Post = Callable[[Callable[[], None]], None]
"""Runs a callable in the right thread, such as `WorkQueue.post`."""

Work = Callable[[], None]


def on_input(post: Post, widget: Any, take: Callable[[Any], None]) -> None:
    """
    Call a function in another thread with each value that a user enters in a widget.

    Parameters
    ----------
    post
        Runs a callable in the right thread, such as `WorkQueue.post`.
    widget
        A widget of viser that has a value.
    take
        Receives the value. Values set by a program are not reported.

    """
    widget.on_update(_passing_on(post, take))


def on_choice(post: Post, group: Any, take: Callable[[str], None]) -> None:
    """
    Call a function in another thread with the label of each button that is pressed in a group.

    Parameters
    ----------
    post
        Runs a callable in the right thread, such as `WorkQueue.post`.
    group
        A button group of viser.
    take
        Receives the label of the button.

    """
    group.on_click(_passing_on(post, take))


def on_click(post: Post, button: Any, do: Callable[[], None]) -> None:
    """
    Call a function in another thread whenever a button is pressed.

    Parameters
    ----------
    post
        Runs a callable in the right thread, such as `WorkQueue.post`.
    button
        A button of viser.
    do
        Called without arguments.

    """
    button.on_click(lambda event: post(do))


def _passing_on(post: Post, take: Callable[[Any], None]) -> Callable[[Any], None]:
    def pass_on(event: Any) -> None:
        if event.client is not None:
            value = event.target.value
            post(lambda: take(value))

    return pass_on


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
