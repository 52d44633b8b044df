# SPDX-License-Identifier: Apache-2.0
"""The tool that selects what is clicked."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rviz_common.context import Context
from rviz_common.selection import Ray
from rviz_common.tool import ObjectTool

__all__ = ['Select']

NONE = 'Deselect'


class Select(ObjectTool):
    """
    Tool that selects the link of a robot, or the marker, that is clicked.

    Escape selects nothing, whichever tool is active.

    Parameters
    ----------
    context, root, given
        As for `Tool`.

    """

    CLASS = 'rviz_default_plugins/Select'
    NAME = 'Select'
    HINT = 'Click on a link of the robot or on an object. A click beside it or Escape deselects.'

    def __init__(
        self, context: Context, root: str, given: Mapping[str, Any] | None = None
    ) -> None:
        super().__init__(context, root, given)
        self._command: Any = None

    def begin(self) -> None:
        """Make Escape select nothing."""
        self._command = self.context.gui.add_command(NONE, hotkey='escape')
        self._command.on_trigger(lambda event: self.context.queue.post(self._deselect))

    def close(self) -> None:
        """Release Escape."""
        if self._command is not None:
            self._command.remove()
            self._command = None

    def click_along(self, ray: Ray) -> bool:
        """
        Select the first object on a ray, or nothing.

        Parameters
        ----------
        ray
            As for `ObjectTool.click_along`.

        """
        selection = self.context.visualizer.selection
        hit = selection.pick(ray)
        selection.choose(None if hit is None else hit.found)
        return False

    def _deselect(self) -> None:
        self.context.visualizer.selection.choose(None)
