# SPDX-License-Identifier: Apache-2.0
"""The tree of displays."""

from __future__ import annotations

from typing import Any

from rviz_common.pace import Pace
from rviz_common.panel import Panel
from rviz_common.panels.add_display import AddDisplay
from rviz_common.panels.entry_folder import EntryFolder
from rviz_common.panels.property_editor import PropertyEditor
from rviz_common.visualizer.entry import Entry
from rviz_common.visualizer.options import FIXED_FRAME

__all__ = ['DisplaysPanel']


class DisplaysPanel(Panel):
    """The tree of displays with their properties, and the global options."""

    CLASS = 'rviz_common/Displays'
    UNUSED = ('Help Height', 'Property Tree Widget', 'Splitter Ratio', 'Tree Height')

    def start(self) -> None:
        """Add the widgets."""
        self._visualizer = self.context.visualizer
        self._pace = Pace()
        gui = self.context.gui
        with gui.add_folder('Global Options', expand_by_default=False):
            self._frames: Any = gui.add_dropdown('Known frames', [self._fixed_frame()])
            self.context.on_input(self._frames, self._choose_frame)
            self._options = PropertyEditor(
                self.context, self._visualizer.options, self._visualizer.set_option
            )
        self._add = AddDisplay(self.context)
        self._tree = gui.add_folder(None)
        self._folders: dict[Entry, EntryFolder] = {}
        self._revision = -1

    def update(self) -> None:
        """Update the widgets."""
        if self._revision != self._visualizer.revision:
            self._revision = self._visualizer.revision
            self._follow_tree()
        self._options.update()
        for folder in self._folders.values():
            folder.update()
        if self._pace.is_due():
            self._say()

    def _say(self) -> None:
        frames = tuple(sorted({self._fixed_frame(), *self._visualizer.watch.names()}))
        if frames != self._frames.options:
            self._frames.options = frames
        if self._frames.value != self._fixed_frame():
            self._frames.value = self._fixed_frame()
        self._add.update()
        for folder in self._folders.values():
            folder.say()

    def _follow_tree(self) -> None:
        """Add folders for new displays, and remove those of deleted displays."""
        entries = self._visualizer.displays.children
        for entry in [each for each in self._folders if each not in entries]:
            self._folders.pop(entry).folder.remove()
        with self._tree:
            for entry in entries:
                if entry not in self._folders:
                    self._folders[entry] = EntryFolder(self.context, entry)
        for folder in self._folders.values():
            folder.follow()

    def _fixed_frame(self) -> str:
        return str(self._visualizer.options[FIXED_FRAME])

    def _choose_frame(self, frame: str) -> None:
        self._visualizer.set_option(FIXED_FRAME, frame)
