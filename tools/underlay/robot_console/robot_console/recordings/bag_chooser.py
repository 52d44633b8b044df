# SPDX-License-Identifier: Apache-2.0
"""Widgets to select one of the recordings of a folder."""

from __future__ import annotations

from collections.abc import Callable
import os
import threading
from typing import Any

from robot_console.recordings.bags import Bag, Shelf
from robot_console.recordings.widgets import about, assign, clock_text, topics_table
from rviz_common.context import Context
from rviz_common.pace import Pace
from rviz_common.status import escaped

__all__ = ['BagChooser']

NONE = '(none)'
PERIOD_S = 4.0


class BagChooser:
    """
    Widgets to select a recording from a folder, which is read in a background thread.

    Call `add_details` once before the first `update`.

    Parameters
    ----------
    context
        The context of the panel; the widgets are added at the current position of its GUI.
    folder
        The path of the folder.
    unfinished
        Returns the path of the recording in progress, which is not listed; '' if there is none.
    chosen
        Called when another recording is selected.

    """

    def __init__(
        self,
        context: Context,
        folder: str,
        unfinished: Callable[[], str],
        chosen: Callable[[], None],
    ) -> None:
        self._context = context
        self._shelf = Shelf(folder)
        self._unfinished = unfinished
        self._chosen = chosen
        self._pace = Pace(PERIOD_S)
        self._is_looking = self._is_over = False
        self._wanted = ''
        self._bags: dict[str, Bag] = {}
        self._list: Any = context.gui.add_dropdown('Recording', [NONE])
        self._text: Any = context.gui.add_markdown('')
        context.on_input(self._list, self._choose)

    def add_details(self) -> None:
        """Add the widget with the topics, which may be placed elsewhere."""
        gui = self._context.gui
        self._topics: Any = gui.add_folder('Topics', expand_by_default=False, visible=False)
        with self._topics:
            self._details: Any = gui.add_html('')

    @property
    def bag(self) -> Bag | None:
        """Return the selected recording if it can be played, else None."""
        bag = self._bags.get(self._list.value)
        return None if bag is None or bag.problem else bag

    def update(self) -> None:
        """Rescan the folder periodically, in a background thread."""
        if not self._is_looking and self._pace.is_due():
            self._is_looking = True
            threading.Thread(target=self._look, daemon=True).start()

    def choose(self, path: str) -> None:
        """
        Select a new recording as soon as it is found in the folder.

        Parameters
        ----------
        path
            The path of the recording.

        """
        self._wanted = path
        self._pace.hurry()

    def close(self) -> None:
        """Stop updating the widgets, even if a scan is still running."""
        self._is_over = True

    def _look(self) -> None:
        unfinished = self._unfinished()  # it may finish during the scan, after it was read
        try:
            bags = self._shelf.look()
        finally:
            self._is_looking = False
        self._context.queue.post(lambda: self._take(bags, unfinished))

    def _take(self, bags: list[Bag], unfinished: str) -> None:
        if self._is_over:
            return
        left_out = (unfinished, self._unfinished())
        found = {_label(bag): bag for bag in bags if bag.path not in left_out}
        if found != self._bags:
            self._bags = found
            before = self._list.value
            assign(self._list, options=tuple(found) or (NONE,))
            for label in (each for each, bag in found.items() if bag.path == self._wanted):
                self._wanted = ''
                assign(self._list, value=label)
            if self._list.value != before:
                self._chosen()
        self._describe()

    def _choose(self, label: str) -> None:
        self._describe()
        self._chosen()

    def _describe(self) -> None:
        bag = self._bags.get(self._list.value)
        if bag is None:
            head = f'No recordings in {escaped(_short(self._shelf.folder))} yet.'
        else:
            head = about(bag)
        topics = bag.topics if bag is not None else ()
        if self._shelf.left_out_count:
            head += f'\n\n{self._shelf.left_out_count} older ones are not listed.'
        assign(self._text, content=head)
        assign(self._details, content=topics_table(topics))
        assign(self._topics, visible=bool(topics))


def _label(bag: Bag) -> str:
    return f'{bag.name} ✖' if bag.problem else f'{bag.name} ({clock_text(bag.duration_s)})'


def _short(path: str) -> str:
    home = os.path.expanduser('~')
    return f'~{path[len(home) :]}' if path.startswith(f'{home}/') else path
