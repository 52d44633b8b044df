# SPDX-License-Identifier: Apache-2.0
"""Where the panels are in the page: in the row of tabs, or in a dock on the left."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TYPE_CHECKING

from rviz_common.panel import TABS_ORDER

if TYPE_CHECKING:
    from viser import GuiApi

__all__ = ['Dock']

WIDTH_PX = 380


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
        self._tabs: list[Any] = []
        self._docked: dict[str, Any] = {}

    @property
    def in_row(self) -> list[str]:
        """The names of the tabs in the row."""
        return [] if self._group is None else list(self._group._tab_labels)

    @property
    def on_left(self) -> list[str]:
        """The names of the tabs on the left, from top to bottom."""
        return [panel._tab_labels[0] for panel in self._docked.values()]

    def add(self, name: str, neighbors: Sequence[Any] = ()) -> Any:
        """
        Add a tab to the row.

        Parameters
        ----------
        name
            The name of the tab.
        neighbors
            Tabs to the right of which it is placed; without them, it is the last one.

        Returns
        -------
        Any
            The tab, as a context for its widgets.

        """
        if self._group is None:
            self._group = self._gui.add_tab_group(order=TABS_ORDER)
        tab = self._group.add_tab(name)
        ids = {each._id for each in neighbors}
        places = [place for place, each in enumerate(self._tabs, 1) if each._id in ids]
        self._tabs.insert(places[0] if places else len(self._tabs), tab)
        self._arrange_row()
        return tab

    def is_docked(self, tab: Any) -> bool:
        """
        Whether a tab is on the left.

        Parameters
        ----------
        tab
            The tab.

        """
        return tab._id in self._docked

    def move_left(self, tab: Any) -> None:
        """
        Move a tab to the left, below those that are already there.

        Parameters
        ----------
        tab
            The tab, which is in the row.

        """
        panel = self._docked[tab._id] = self._gui.add_panel()
        self._arrange_row()
        _fill(panel, [tab])
        tab._parent = panel
        self._arrange_left()

    def move_back(self, tab: Any) -> None:
        """
        Move a tab back to its place in the row.

        Parameters
        ----------
        tab
            The tab, which is on the left.

        """
        panel = self._docked.pop(tab._id)
        _fill(panel, [])  # otherwise what is in the tab would be removed, too
        panel.remove()
        tab._parent = self._group
        self._arrange_row()
        self._arrange_left()

    def close(self) -> None:
        """Remove the tabs, and the widgets in them."""
        for panel in self._docked.values():
            panel.remove()
        if self._group is not None:
            self._group.remove()

    def _arrange_row(self) -> None:
        _fill(self._group, [each for each in self._tabs if each._id not in self._docked])

    def _arrange_left(self) -> None:
        """Dock the first panel at the edge, and each other one below the one before."""
        above = None
        for panel in self._docked.values():
            if above is None:
                panel.dock_left()
                panel.set_width(WIDTH_PX)
            else:
                panel.dock_below(above)
            above = panel


def _fill(container: Any, tabs: list[Any]) -> None:
    """Set the tabs of a group or a panel; viser has only a way to append new ones."""
    container._tab_handles[:] = tabs
    container._rebuild_tab_props()
