# SPDX-License-Identifier: Apache-2.0
"""A page with turtles, for which a test lets time pass."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import time
from typing import Any

from rviz_common.inputs import WorkQueue
from rviz_common.page import NO_TOKEN, PageSettings
from turtlesim_py.turtle import Turtle
from turtlesim_py.turtle_page import TurtlePage
from turtlesim_py.world import World

__all__ = ['Stage', 'stage']


class Stage:
    """A page and its turtles."""

    def __init__(self, settings: PageSettings) -> None:
        """Serve the page, with a turtle in the middle."""
        self.world = World(time.monotonic())
        self.turtle: Turtle = self.world.reset()
        self._queue = WorkQueue()
        self.page = TurtlePage('/zoo/turtlesim', self.world, self._queue, settings)
        self.url = self.page.urls[0]

    def until(self, is_so: Callable[[], Any], what: str) -> None:
        """Do what the node does, until something is so."""
        end_s = time.monotonic() + 100.0
        while not is_so():
            assert time.monotonic() < end_s, what
            self._queue.run()
            self.world.advance(time.monotonic())
            self.page.refresh()
            time.sleep(0.01)


@contextmanager
def stage(token: str = NO_TOKEN, port: int | None = None) -> Iterator[Stage]:
    """Serve a page as long as the `with` lasts."""
    made = Stage(PageSettings(port=port, token=token))
    try:
        yield made
    finally:
        made.page.close()
