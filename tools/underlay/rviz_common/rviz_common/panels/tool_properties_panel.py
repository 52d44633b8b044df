# SPDX-License-Identifier: Apache-2.0
"""The properties of the tools."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rviz_common.panel import Panel
from rviz_common.panels.property_editor import PropertyEditor
from rviz_common.tool import Tool

__all__ = ['ToolPropertiesPanel']


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
