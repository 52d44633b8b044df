# SPDX-License-Identifier: Apache-2.0
"""The tools of a file, one of which may be active."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
import copy
from typing import Any

from rviz_common.context import Context
from rviz_common.described_error import described_error
from rviz_common.plugins import load_plugin, TOOLS
from rviz_common.tool import Point, Tool
from rviz_common.visualizer.cameras import WORLD
from rviz_common.visualizer.ground import Ground

__all__ = ['BUILT_IN', 'ToolBox']

BUILT_IN = tuple(
    f'rviz_default_plugins/{name}'
    for name in ('Interact', 'MoveCamera', 'Select', 'FocusCamera', 'ZoomTool', 'FPSMotion')
)
"""Tools of RViz that a browser has built in, or that do not apply there."""


class ToolBox:
    """
    The tools of a file, one of which may be active; other entries are preserved for the file.

    Parameters
    ----------
    context
        The context of the tools.
    origin
        Returns the position of the camera's target frame, in m in the fixed frame.
    entries
        The entries of the section `Tools` of the file.

    Attributes
    ----------
    in_use
        The active tool, if any.

    """

    def __init__(
        self,
        context: Context,
        origin: Callable[[], Point],
        entries: Sequence[Mapping[str, Any]],
    ) -> None:
        self._logger = context.node.get_logger()
        self._entries: list[Tool | Mapping[str, Any]] = [
            self._made(context, f'{WORLD}/tools/{number}', entry)
            for number, entry in enumerate(entries)
        ]
        self._ground = Ground(context, origin, self._click, self._drag)
        self.in_use: Tool | None = None
        for tool in self.tools:
            tool.begin()

    @property
    def tools(self) -> list[Tool]:
        """The tools of known classes."""
        return [each for each in self._entries if isinstance(each, Tool)]

    @property
    def unknown(self) -> list[str]:
        """The classes of the entries that are unknown."""
        classes = [entry['Class'] for entry in self._entries if not isinstance(entry, Tool)]
        return [each for each in classes if each not in BUILT_IN]

    def use(self, tool: Tool | None) -> None:
        """
        Activate a tool, and deactivate the previous one.

        Parameters
        ----------
        tool
            One of `tools`; None for none, so that the pointer turns the scene.

        """
        if self.in_use is not None:
            self.in_use.lay_down()
        self.in_use = tool
        if tool is not None:
            tool.take_up()
        self._ground.watch(tool is not None)

    def to_file(self) -> list[dict[str, Any]]:
        """Return the entry for the .rviz file."""
        return [
            each.to_file() if isinstance(each, Tool) else copy.deepcopy(dict(each))
            for each in self._entries
        ]

    def close(self) -> None:
        """Close all tools."""
        self.use(None)
        for tool in self.tools:
            tool.close()

    def _made(
        self, context: Context, root: str, entry: Mapping[str, Any]
    ) -> Tool | Mapping[str, Any]:
        try:
            tool: Tool = load_plugin(TOOLS, entry['Class'])(context, root, entry)
        except (LookupError, ImportError):
            return entry
        return tool

    def _click(self, point: Point) -> None:
        self._pass_on(lambda tool: tool.click(point))

    def _drag(self, start: Point, end: Point, is_over: bool) -> None:
        self._pass_on(lambda tool: tool.drag(start, end, is_over))

    def _pass_on(self, work: Callable[[Tool], bool]) -> None:
        """Run a callable of the active tool; deactivate the tool when it is done or fails."""
        tool = self.in_use
        if tool is None:
            return
        try:
            is_done = work(tool)
        except Exception as error:  # a failing tool must not stop anything else
            self._logger.error(f"Tool '{tool.NAME}' failed: {described_error(error)}")
            is_done = True
        if is_done:
            self.use(None)
