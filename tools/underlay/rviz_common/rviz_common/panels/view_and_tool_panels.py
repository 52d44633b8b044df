# SPDX-License-Identifier: Apache-2.0
"""The panels of the views and of the tools, with their properties."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rviz_common.panel import Panel
from rviz_common.panels.property_editor import PropertyEditor
from rviz_common.status import escaped, Level, MARKS
from rviz_common.tool import Tool
from rviz_common.view import KINDS, View

__all__ = ['ToolPropertiesPanel', 'ViewsPanel']

TYPES = {kind.NAME: kind for kind in KINDS.values()}


class ViewsPanel(Panel):
    """The kind of the view, its properties, and the saved views."""

    CLASS = 'rviz_common/Views'
    UNUSED = ('Expanded', 'Splitter Ratio')

    def start(self) -> None:
        """Add the widgets."""
        self._cameras = self.context.visualizer.cameras
        gui, view = self.context.gui, self._cameras.view
        self._kind: Any = gui.add_dropdown('Type', list(TYPES), initial_value=view.kind.NAME)
        self.context.on_input(self._kind, self._choose_kind)
        self._reason = gui.add_markdown('', visible=False)
        self._folder: Any = None
        self._shown: Any = None
        with gui.add_folder(None):
            take = gui.add_button('Take this view', hint='Copy the view of this browser.')
            back = gui.add_button('Back to the view', hint='Apply this view in all browsers.')
        take.on_click(lambda event: self._post_take(event.client_id))
        self.context.on_click(back, lambda: self._cameras.show(self._cameras.view))
        self._place = gui.add_folder(None)
        self._saved = gui.add_folder('Saved views', expand_by_default=False)
        self._listed: list[Any] = []
        with self._saved:
            self._name = gui.add_text('Name', 'View')
            save = gui.add_button('Save this view', hint='Save the view of this browser.')
        save.on_click(lambda event: self._post_save(event.client_id))
        self._list()

    def update(self) -> None:
        """Update the widgets."""
        view = self._cameras.view
        if view is not self._shown:
            self._shown = view
            self._edit(view)
        self._editor.update()
        reason = self._cameras.reason
        text = f'{MARKS[Level.WARN]} {escaped(reason)}' if reason else ''
        if text != self._reason.content:
            self._reason.content = text
            self._reason.visible = bool(text)

    def _edit(self, view: View) -> None:
        """Show the properties of a view."""
        if self._folder is not None:
            self._folder.remove()
        with self._place:
            self._folder = self.context.gui.add_folder('Current View')
        with self._folder:
            self._editor = PropertyEditor(self.context, view.values, self._change)
        if self._kind.value != view.kind.NAME:
            self._kind.value = view.kind.NAME

    def _change(self, path: str, value: Any) -> None:
        self._cameras.view.change(path, value)
        self._cameras.show(self._cameras.view)

    def _choose_kind(self, name: str) -> None:
        self._cameras.show(self._cameras.view.like(TYPES[name]))

    def _post_take(self, client_id: int | None) -> None:
        self.context.queue.post(lambda: self._take(client_id))

    def _take(self, client_id: int | None) -> None:
        camera = self._cameras.seen_by(client_id)
        if camera is not None:
            self._cameras.view.take(camera)

    def _post_save(self, client_id: int | None) -> None:
        self.context.queue.post(lambda: self._save(client_id))

    def _save(self, client_id: int | None) -> None:
        camera = self._cameras.seen_by(client_id)
        view = self._cameras.view
        saved = view.like(view.kind, camera)
        saved.name = self._name.value.strip() or 'View'
        self.context.visualizer.saved_views.append(saved)
        self._list()

    def _list(self) -> None:
        """Show a button for each saved view."""
        for button in self._listed:
            button.remove()
        with self._saved:
            self._listed = [self._button(view) for view in self.context.visualizer.saved_views]

    def _button(self, view: View) -> Any:
        button = self.context.gui.add_button(view.name, hint=view.kind.NAME, color='gray')
        self.context.on_click(button, lambda: self._cameras.show(view.copy('Current View')))
        return button


class ToolPropertiesPanel(Panel):
    """The properties of the tools, each in a folder."""

    CLASS = 'rviz_common/Tool Properties'
    UNUSED = ('Expanded', 'Splitter Ratio')

    def start(self) -> None:
        """Add the widgets."""
        self._editors = [
            self._editor(tool) for tool in self.context.visualizer.tools.tools if tool.PROPERTIES
        ]

    def update(self) -> None:
        """Apply the values that were entered."""
        for editor in self._editors:
            editor.update()

    def _editor(self, tool: Tool) -> PropertyEditor:
        with self.context.gui.add_folder(tool.NAME, expand_by_default=False):
            return PropertyEditor(self.context, tool.values, _change(tool))


def _change(tool: Tool) -> Callable[[str, Any], None]:
    """Return a function that sets a property of a tool."""

    def change(path: str, value: Any) -> None:
        before = tool.values[path]
        tool.values[path] = value
        if tool.values[path] != before:
            tool.on_change(path)

    return change
