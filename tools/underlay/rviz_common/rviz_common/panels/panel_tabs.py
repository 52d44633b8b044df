# SPDX-License-Identifier: Apache-2.0
"""The panels of a file, each in a tab of the page, or docked on its left side."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import nullcontext
import copy
from typing import Any

from rviz_common.context import Context
from rviz_common.pace import Pace
from rviz_common.panel import Panel
from rviz_common.panels.dock import Dock
from rviz_common.plugins import load_plugin, PANELS, PANELS_ON_DEMAND, plugin_names
from rviz_common.status import described_error, escaped
from rviz_common.widget_order import DOCK_ORDER
from viser import Icon

__all__ = ['BUILT_IN', 'PanelTabs']

BUILT_IN = ('rviz_common/Help', 'rviz_common/Transformation')
"""Panels of RViz that do not apply in a browser."""
LOOK_S = 2.0
TO_LEFT = 'Dock on the left', Icon.LAYOUT_SIDEBAR
TO_TABS = 'Back to the tabs', Icon.LAYOUT_SIDEBAR_RIGHT
"""The label and the icon of the button of each panel; `viser.css` knows it by its icon."""


class PanelTabs:
    """
    The panels of a file, most in a tab each; other entries are preserved for the file.

    Panels on demand that the file does not list appear once their subject is available, and
    stay; they are not written to the file.

    Parameters
    ----------
    context
        The context of the panels.
    entries
        The entries of the section `Panels` of the file.

    Attributes
    ----------
    dock
        Where the tabs are.
    failures
        The classes that cannot be imported, with the errors.

    """

    def __init__(self, context: Context, entries: Sequence[Mapping[str, Any]]) -> None:
        self._context = context
        self._logger = context.node.get_logger()
        self.failures: dict[str, str] = {}
        self._entries: list[Panel | Mapping[str, Any]] = [self._made(entry) for entry in entries]
        self.dock = Dock(context.gui)
        self._tabs: dict[Panel, Any] = {}
        self._running = [panel for panel in self.panels if self._started(panel)]
        listed = {each['Class'] for each in entries}
        self._awaited = [each for each in plugin_names(PANELS_ON_DEMAND) if each not in listed]
        self._look = Pace(LOOK_S)

    @property
    def panels(self) -> list[Panel]:
        """The panels of known classes."""
        return [each for each in self._entries if isinstance(each, Panel)]

    @property
    def unknown(self) -> list[str]:
        """The classes of the entries that are unknown."""
        classes = [entry['Class'] for entry in self._entries if not isinstance(entry, Panel)]
        return [each for each in classes if each not in BUILT_IN]

    def update(self) -> None:
        """Update the widgets."""
        if self._awaited and self._look.is_due():
            self._look_for_awaited()
        for panel in list(self._running):
            if not self._guarded(panel, panel.update):
                self._running.remove(panel)

    def to_file(self) -> list[dict[str, Any]]:
        """Return the entry for the .rviz file."""
        return [
            each.to_file() if isinstance(each, Panel) else copy.deepcopy(dict(each))
            for each in self._entries
        ]

    def close(self) -> None:
        """Close the panels, and remove them from the page."""
        for panel in self._running:
            self._guarded(panel, panel.close)
        self.dock.close()

    def _look_for_awaited(self) -> None:
        """Add the panels on demand that have become wanted."""
        for name in list(self._awaited):
            try:
                kind = load_plugin(PANELS_ON_DEMAND, name)
                is_wanted = kind.is_wanted(self._context.node)
            except Exception as error:  # a failing panel must not stop the others
                self._awaited.remove(name)
                self._logger.error(f"Panel '{name}' cannot be used: {described_error(error)}")
                continue
            if is_wanted:
                self._awaited.remove(name)
                self._add(kind(self._context))

    def _add(self, panel: Panel) -> None:
        """Add a panel on demand, next to the one that it follows."""
        followed = [self._tabs[each] for each in self._tabs if each.CLASS == panel.FOLLOWS]
        if self._started(panel, followed):
            self._running.append(panel)

    def _made(self, entry: Mapping[str, Any]) -> Panel | Mapping[str, Any]:
        try:
            panel: Panel = load_plugin(PANELS, entry['Class'])(self._context, entry)
        except LookupError:
            return entry
        except ImportError as error:
            self.failures[entry['Class']] = str(error)
            return entry
        return panel

    def _started(self, panel: Panel, neighbors: Sequence[Any] = ()) -> bool:
        tab = nullcontext() if panel.IS_ALWAYS_VISIBLE else self._tab_of(panel, neighbors)
        try:
            with tab:
                panel.start()
        except ValueError as error:  # a message about the contents of the file
            self._logger.error(f'{_named(panel)} is not shown: {error}')
            self._say(panel, str(error))
        except Exception as error:  # a failing panel must not stop the others
            self._report(panel, error)
        else:
            return True
        return False

    def _tab_of(self, panel: Panel, neighbors: Sequence[Any]) -> Any:
        """Add the tab of a panel, with the button that moves it, where the file says."""
        tab = self._tabs[panel] = self.dock.add(panel.name, neighbors)
        with tab:
            button = self._context.gui.add_button('', color='gray', order=DOCK_ORDER)
        self._context.on_click(button, lambda: self._move(panel, button))
        if panel.is_docked:
            self.dock.move_left(tab)
        _label(button, panel.is_docked)
        return tab

    def _move(self, panel: Panel, button: Any) -> None:
        """Move a panel to the dock, or back, as its button demands."""
        panel.dock(not panel.is_docked)
        if panel.is_docked:
            self.dock.move_left(self._tabs[panel])
        else:
            self.dock.move_back(self._tabs[panel])
        _label(button, panel.is_docked)

    def _guarded(self, panel: Panel, work: Callable[[], None]) -> bool:
        """Run a callable of a panel and log a failure; return whether it succeeded."""
        try:
            work()
        except Exception as error:  # a failing panel must not stop the others
            self._report(panel, error)
            return False
        return True

    def _report(self, panel: Panel, error: Exception) -> None:
        self._logger.error(f'{_named(panel)} has been stopped: {described_error(error)}')
        self._say(panel, 'It has been stopped by an error: see the log.')

    def _say(self, panel: Panel, sentence: str) -> None:
        """Show in the tab of a panel why it is missing."""
        if not panel.IS_ALWAYS_VISIBLE:
            with self._tabs[panel]:
                self._context.gui.add_markdown(f'✖ {escaped(sentence)}')


def _label(button: Any, is_docked: bool) -> None:
    button.label, button.icon = TO_TABS if is_docked else TO_LEFT


def _named(panel: Panel) -> str:
    return f"Panel '{panel.name}' ({panel.CLASS})"
