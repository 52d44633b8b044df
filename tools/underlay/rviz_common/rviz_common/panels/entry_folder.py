# SPDX-License-Identifier: Apache-2.0
"""The widgets of an entry of the tree of displays."""

from __future__ import annotations

from typing import Any

from rviz_common.context import Context
from rviz_common.panels.marks import MARKS, status_text
from rviz_common.panels.property_editor import PropertyEditor
from rviz_common.properties import Text, Values
from rviz_common.status import Level
from rviz_common.visualizer.display_entry import DisplayEntry
from rviz_common.visualizer.entry import Entry
from rviz_common.visualizer.group import Group

__all__ = ['EntryFolder']

NAME = Text('Name', '', 'What it is called here and in the file.')


class EntryFolder:
    """
    A folder with a checkbox to enable a display, its status and its properties.

    Parameters
    ----------
    context
        The page, and the visualizer from which the entry can be removed.
    entry
        A display or a group; the folder of a group contains those of its displays.

    Attributes
    ----------
    folder
        The handle that viser has for the folder.

    """

    def __init__(self, context: Context, entry: Entry) -> None:
        self._context = context
        self._entry = entry
        self._label = self._wanted_label()
        self.folder = context.gui.add_folder(
            self._label, expand_by_default=isinstance(entry, Group)
        )
        with self.folder:
            self._add()

    def update(self) -> None:
        """Update the widgets."""
        for editor in self._editors:
            editor.update()
        for below in self._below.values():
            below.update()

    def say(self) -> None:
        """Update the status that is shown."""
        label, text = self._wanted_label(), status_text(self._entry.status)
        if label != self._label:
            self._label = self.folder.label = label
        if text != self._text.content:
            self._text.content = text
            self._text.visible = bool(text)
        if self._enabled.value != self._entry.is_enabled:
            self._enabled.value = self._entry.is_enabled
        for below in self._below.values():
            below.say()

    def follow(self) -> None:
        """Add folders for new displays of a group, and remove those of deleted displays."""
        children = self._entry.children if isinstance(self._entry, Group) else []
        for entry in [each for each in self._below if each not in children]:
            self._below.pop(entry).folder.remove()
        for entry in children:
            if entry in self._below:
                self._below[entry].follow()
                continue
            with self._tree:
                self._below[entry] = EntryFolder(self._context, entry)

    def _add(self) -> None:
        gui, entry = self._context.gui, self._entry
        self._enabled: Any = gui.add_checkbox('Enabled', entry.is_enabled, hint=entry.class_name)
        self._context.on_input(self._enabled, entry.enable)
        text = status_text(entry.status)
        self._text = gui.add_markdown(text, visible=bool(text))
        self._editors = []
        if isinstance(entry, DisplayEntry):
            values = entry.display.values
            self._editors.append(
                PropertyEditor(self._context, values, entry.change, without=['Enabled'])
            )
        self._tree = gui.add_folder(None)
        self._below: dict[Entry, EntryFolder] = {}
        self.follow()
        with gui.add_folder('Name, Remove', expand_by_default=False):
            name = Values([NAME], {'Name': entry.name})
            self._editors.append(PropertyEditor(self._context, name, self._rename_in(name)))
            button = gui.add_button('Remove', color='red', hint=f'Remove {entry.name}')
        self._context.on_click(button, lambda: self._context.visualizer.remove(entry))

    def _rename_in(self, values: Values) -> Any:
        def rename(path: str, value: Any) -> None:
            values[path] = value
            self._entry.name = values[path].strip() or self._entry.class_name

        return rename

    def _wanted_label(self) -> str:
        entry = self._entry
        level = entry.level if entry.is_enabled else Level.OK
        mark = f'{MARKS[level]} ' if level else ''
        return f'{mark}{entry.name}' if entry.is_enabled else f'{entry.name} (off)'
