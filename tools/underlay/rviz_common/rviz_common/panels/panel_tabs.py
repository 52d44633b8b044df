# SPDX-License-Identifier: Apache-2.0
"""The panels of a file, each in a tab of the page."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import nullcontext
import copy
from typing import Any

from rviz_common.context import Context
from rviz_common.described_error import described_error
from rviz_common.panel import Panel
from rviz_common.panels.order import TABS_ORDER
from rviz_common.plugins import load_plugin, PANELS

__all__ = ['BUILT_IN', 'PanelTabs']

BUILT_IN = ('rviz_common/Help', 'rviz_common/Selection', 'rviz_common/Transformation')
"""Panels of RViz that mean nothing in a browser."""


class PanelTabs:
    """The panels of a file, most in a tab each; other entries are kept for the file."""

    def __init__(self, context: Context, entries: Sequence[Mapping[str, Any]]) -> None:
        """Add the panels that a file lists."""
        self._context = context
        self._logger = context.node.get_logger()
        self._entries: list[Panel | Mapping[str, Any]] = [self._made(entry) for entry in entries]
        has_tabs = not all(panel.IS_ALWAYS_VISIBLE for panel in self.panels)
        self._tabs: Any = context.gui.add_tab_group(order=TABS_ORDER) if has_tabs else None
        self._running = [panel for panel in self.panels if self._started(panel)]

    @property
    def panels(self) -> list[Panel]:
        """Return the panels that are known."""
        return [each for each in self._entries if isinstance(each, Panel)]

    @property
    def unknown(self) -> list[str]:
        """Return the classes of the entries that nobody knows."""
        classes = [entry['Class'] for entry in self._entries if not isinstance(entry, Panel)]
        return [each for each in classes if each not in BUILT_IN]

    def update(self) -> None:
        """Show what is new."""
        for panel in list(self._running):
            if not self._guarded(panel, panel.update):
                self._running.remove(panel)

    def to_file(self) -> list[dict[str, Any]]:
        """Return what the file is to have."""
        return [
            each.to_file() if isinstance(each, Panel) else copy.deepcopy(dict(each))
            for each in self._entries
        ]

    def close(self) -> None:
        """End the panels, and remove them from the page."""
        for panel in self._running:
            self._guarded(panel, panel.close)
        if self._tabs is not None:
            self._tabs.remove()

    def _made(self, entry: Mapping[str, Any]) -> Panel | Mapping[str, Any]:
        try:
            panel: Panel = load_plugin(PANELS, entry['Class'])(self._context, entry)
        except (LookupError, ImportError):
            return entry
        return panel

    def _started(self, panel: Panel) -> bool:
        tab = nullcontext() if panel.IS_ALWAYS_VISIBLE else self._tabs.add_tab(panel.name)
        with tab:
            has_started = self._guarded(panel, panel.start)
            if not has_started and not panel.IS_ALWAYS_VISIBLE:
                self._context.gui.add_markdown('✖ It has been stopped by an error: see the log.')
        return has_started

    def _guarded(self, panel: Panel, work: Callable[[], None]) -> bool:
        """Have a panel do something; return whether it succeeded."""
        try:
            work()
        except Exception as error:  # whatever a panel does, the others go on
            self._logger.error(
                f"Panel '{panel.name}' ({panel.CLASS}) has been stopped: {described_error(error)}"
            )
            return False
        return True
