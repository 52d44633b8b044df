# SPDX-License-Identifier: Apache-2.0
"""Where the panels are in the page: in the row of tabs, or in a dock on the left."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TYPE_CHECKING

from rviz_common.page.viser_connection import connection_of
from rviz_common.widget_order import TABS_ORDER
from viser._messages import GuiFolderMessage

if TYPE_CHECKING:
    from viser import GuiApi

__all__ = ['Dock']

WIDTH_PX = 380


@dataclass(eq=False)
class _Tab:
    """A tab, in the row or in a panel of viser on the left, and the folder with its widgets."""

    name: str
    folder: Any
    handle: Any
    panel: Any = None


class Dock:
    """
    The row of tabs, and the dock on the left; a tab can be moved from one to the other.

    Tabs in the dock are below each other, so that all of them are in sight. Small screens, on
    which viser has no docks, show them as sections below the tabs.

    Parameters
    ----------
    gui
        The widgets of the page.

    """

    def __init__(self, gui: GuiApi) -> None:
        self._gui = gui
        self._group: Any = None
        self._tabs: list[_Tab] = []
        self._docked: list[_Tab] = []

    def add(self, name: str, neighbors: Sequence[Any] = ()) -> Any:
        """
        Add a tab to the row.

        Parameters
        ----------
        name
            The name of the tab.
        neighbors
            Contexts of tabs to the right of which it is placed; without them, it is the last one.

        Returns
        -------
        Any
            The context for the widgets of the tab, which stays the same when the tab is moved.

        """
        if self._group is None:
            self._group = self._gui.add_tab_group(order=TABS_ORDER)
        handle = self._group.add_tab(name)
        with handle:
            tab = _Tab(name, self._gui.add_folder(None), handle)
        places = [
            place
            for place, each in enumerate(self._tabs, 1)
            if any(each.folder is neighbor for neighbor in neighbors)
        ]
        self._tabs.insert(places[0] if places else len(self._tabs), tab)
        self._arrange_row()
        return tab.folder

    def move_left(self, context: Any) -> None:
        """
        Move a tab from the row to the left, below those that are already there.

        Parameters
        ----------
        context
            Its context, as `add` has returned it.

        """
        tab = self._find(context)
        before, tab.panel = tab.handle, self._gui.add_panel()
        self._hang(tab, tab.panel.add_tab(tab.name))
        before.remove()
        self._docked.append(tab)
        self._arrange_left()

    def move_back(self, context: Any) -> None:
        """
        Move a tab from the left back to its place in the row.

        Parameters
        ----------
        context
            Its context, as `add` has returned it.

        """
        tab = self._find(context)
        before, tab.panel = tab.panel, None
        self._hang(tab, self._group.add_tab(tab.name))
        before.remove()
        self._docked.remove(tab)
        self._arrange_row()
        self._arrange_left()

    def close(self) -> None:
        """Remove the tabs, and the widgets in them."""
        for tab in self._docked:
            tab.panel.remove()
        if self._group is not None:
            self._group.remove()

    def _find(self, context: Any) -> _Tab:
        return next(each for each in self._tabs if each.folder is context)

    def _hang(self, tab: _Tab, handle: Any) -> None:
        """
        Move the folder of a tab into another tab of viser.

        A tab of viser stays where a browser has put it, and so does what is created in it: each
        place needs another one, and the folder is announced once more.
        """
        folder, before, container = tab.folder._impl, tab.handle, handle._id
        folder.parent_container_id = container
        handle._children[folder.uuid] = before._children.pop(folder.uuid)
        tab.handle = handle
        message = GuiFolderMessage(folder.uuid, container, folder.props)
        connection_of(self._gui).queue_message(message)

    def _arrange_row(self) -> None:
        """Order the tabs in the row; viser has only a way to append new ones."""
        self._group._tab_handles[:] = [each.handle for each in self._tabs if each.panel is None]
        self._group._rebuild_tab_props()

    def _arrange_left(self) -> None:
        """Dock the first panel at the edge, and each other one below the one before."""
        above = None
        for panel in (each.panel for each in self._docked):
            if above is None:
                panel.dock_left()
                panel.set_width(WIDTH_PX)
            else:
                panel.dock_below(above)
            above = panel
