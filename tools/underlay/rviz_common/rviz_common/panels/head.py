# SPDX-License-Identifier: Apache-2.0
"""The head of the page: a status summary, and the tools."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from rviz_common.context import Context
from rviz_common.pace import Pace
from rviz_common.panels.marks import escaped, MARKS
from rviz_common.panels.order import STATUS_ORDER, TOOLS_ORDER
from rviz_common.status import Level
from rviz_common.tool import Tool

if TYPE_CHECKING:
    from rviz_common.visualizer.visualizer import Visualizer

__all__ = ['Head']

NAMED = 3
MOVE = 'Move Camera'


class Head:
    """
    The status at a glance, and a button for each tool, at the top of the page.

    Parameters
    ----------
    context
        The page.
    visualizer
        Provides the status, the displays and the tools.

    """

    def __init__(self, context: Context, visualizer: Visualizer) -> None:
        self._visualizer = visualizer
        self._pace = Pace()
        self._text = context.gui.add_markdown('', order=STATUS_ORDER)
        self._folder = context.gui.add_folder(
            'Tools',
            order=TOOLS_ORDER,
            visible=bool(visualizer.tools.tools),
            expand_by_default=False,
        )
        self._buttons: list[tuple[Tool | None, Any]] = []
        with self._folder:
            for tool in (None, *visualizer.tools.tools):
                self._buttons.append((tool, self._button(context, tool)))
            self._hint = context.gui.add_markdown('', visible=False)
        self._shown: Any = _MISSING

    def update(self) -> None:
        """Update the widgets."""
        in_use = self._visualizer.tools.in_use
        if in_use is not self._shown:
            self._shown = in_use
            self._mark(in_use)
        if self._pace.is_due():
            text = self._summary()
            if text != self._text.content:
                self._text.content = text

    def close(self) -> None:
        """Remove the widgets."""
        self._text.remove()
        self._folder.remove()

    def _button(self, context: Context, tool: Tool | None) -> Any:
        name = MOVE if tool is None else tool.NAME
        hint = 'Drag to turn the scene.' if tool is None else tool.HINT
        button = context.gui.add_button(name, hint=hint, color='gray')
        context.on_click(button, lambda: self._visualizer.tools.use(tool))
        return button

    def _mark(self, in_use: Tool | None) -> None:
        for tool, button in self._buttons:
            button.color = 'blue' if tool is in_use else 'gray'
        self._hint.visible = in_use is not None
        if in_use is not None:
            self._hint.content = in_use.HINT

    def _summary(self) -> str:
        """Summarise the status, the worst first."""
        visualizer = self._visualizer
        lines = [
            f'{MARKS[level]} **{subject}**: {escaped(sentence)}'
            for subject, level, sentence in visualizer.status.items()
            if level
        ]
        bad = [
            each for each in visualizer.displays.walk() if each.is_enabled and each.status.level
        ]
        for level in (Level.ERROR, Level.WARN):
            names = [escaped(each.name) for each in bad if each.level is level]
            if names:
                more = f' and {len(names) - NAMED} more' if len(names) > NAMED else ''
                lines.append(f'{MARKS[level]} {", ".join(names[:NAMED])}{more}: see Displays')
        return '\n\n'.join(lines) or f'{MARKS[Level.OK]} No display problems.'


_MISSING = object()
